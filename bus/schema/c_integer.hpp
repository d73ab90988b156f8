#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace priamos::bus {

/// A whole number in C notation, decimal, 0x.. or 0.. (octal): lcm-gen copies it into C++ as it is. nullopt
/// for any other text, and for a number that an int64_t cannot hold.
std::optional<std::int64_t> ParseCInteger(std::string_view text);

}  // namespace priamos::bus
