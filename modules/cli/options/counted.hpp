#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace priamos::cli {

/// "1 event", "2 events": a number with what it counts, `one` of them.
inline std::string Counted(std::uint64_t number, std::string_view one) {
  return fmt::format("{} {}{}", number, one, number == 1 ? "" : "s");
}

}  // namespace priamos::cli
