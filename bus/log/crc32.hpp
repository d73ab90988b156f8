#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace priamos::bus {

/// CRC-32 of IEEE 802.3 (as zlib has it); `crc` is the value so far, 0 at the beginning.
inline std::uint32_t Crc32(std::uint32_t crc, std::string_view bytes) {
  static constexpr auto kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ (value & 1 ? 0xEDB88320u : 0u);
      table[i] = value;
    }
    return table;
  }();
  crc = ~crc;
  for (const char c : bytes) crc = crc >> 8 ^ kTable[(crc ^ static_cast<std::uint8_t>(c)) & 0xff];
  return ~crc;
}

}  // namespace priamos::bus
