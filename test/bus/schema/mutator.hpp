#pragma once

#include "common/random.hpp"
#include "encoding.hpp"

namespace priamos::bus {

/// Damages an encoded message as lines, bugs and attackers do: flipped bits, extreme numbers in places where
/// counts and lengths are, cut, grown, shifted. Most mutants keep the fingerprint, so that what is behind
/// it gets tested.
inline void Mutate(Bytes& bytes, Rng& rng) {
  const auto position = [&](std::size_t width) {
    const std::size_t first = rng.Chance(0.98) ? 8 : 0;
    return bytes.size() <= first + width ? 0 : first + rng.Below(bytes.size() - first - width + 1);
  };
  const auto write = [&](std::int64_t value, std::size_t width) {
    if (bytes.size() >= width) WriteInteger(bytes.data() + position(width), value, width);
  };
  const std::size_t widths[] = {1, 2, 4, 8};
  const std::size_t width = widths[rng.Below(4)];
  switch (rng.Below(8)) {
    case 0:
      if (!bytes.empty()) bytes[position(1)] ^= static_cast<std::byte>(1 << rng.Below(8));
      break;
    case 1:
      write(-1 - static_cast<std::int64_t>(rng.Below(3)), width);
      break;
    case 2:
      write(std::int64_t{1} << rng.Below(63), width);
      break;
    case 3:
      write(static_cast<std::int64_t>(rng.Below(300)), width);
      break;
    case 4:
      write(static_cast<std::int64_t>(rng.engine()()), width);
      break;
    case 5:
      bytes.resize(rng.Below(bytes.size() + 1));
      break;
    case 6:
      bytes.resize(bytes.size() + rng.Below(64), static_cast<std::byte>(rng.Below(256)));
      break;
    default:
      if (bytes.size() > 8) bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(position(1)));
  }
}

}  // namespace priamos::bus
