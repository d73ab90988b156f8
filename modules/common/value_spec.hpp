#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace priamos {

/// What one value of a configuration means and may be; printed by --print-config and checked on loading.
struct ValueSpec {
  std::string_view unit;  ///< "m", "rad/s", "-" ...
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
  std::string_view doc;  ///< one sentence
};

/// Text of what `spec` allows: `0 to 1.5`, `at least 0`, `any`.
std::string RangeText(const ValueSpec& spec);

}  // namespace priamos
