#include "common/archive.hpp"

#include <fmt/format.h>

namespace priamos {

std::string RangeText(const ValueSpec& spec) {
  const bool low = spec.min > std::numeric_limits<double>::lowest();
  const bool high = spec.max < std::numeric_limits<double>::max();
  if (low && high) return fmt::format("{} to {}", spec.min, spec.max);
  if (low) return fmt::format("at least {}", spec.min);
  if (high) return fmt::format("at most {}", spec.max);
  return "any";
}

std::string_view LiveText(LiveChange change) {
  switch (change) {
    case LiveChange::kInRange:
      return "live";
    case LiveChange::kOnlyLower:
      return "live, at most the file's";
    case LiveChange::kOnlyHigher:
      return "live, at least the file's";
  }
  return "live";
}

}  // namespace priamos
