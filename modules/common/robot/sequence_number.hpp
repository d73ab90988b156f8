#pragma once

#include <cstdint>

namespace priamos {

/// Whether the 16-bit sequence number `a`, which counts up and wraps, comes after `b`: it is less than half a
/// round ahead.
constexpr bool IsAfter(int a, int b) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(a) - static_cast<std::uint16_t>(b)) > 0;
}

}  // namespace priamos
