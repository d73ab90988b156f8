#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

/// LCM encodes every number big endian, without padding.
namespace priamos::bus {

namespace internal {
template <std::size_t kSize>
struct Word;
template <>
struct Word<1> {
  using Type = std::uint8_t;
};
template <>
struct Word<2> {
  using Type = std::uint16_t;
};
template <>
struct Word<4> {
  using Type = std::uint32_t;
};
template <>
struct Word<8> {
  using Type = std::uint64_t;
};
}  // namespace internal

/// The number T (any integer, float or double) in the sizeof(T) bytes at `from`.
template <class T>
T ReadBigEndian(const std::byte* from) {
  using Word = typename internal::Word<sizeof(T)>::Type;
  Word word = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    word = static_cast<Word>(static_cast<std::uint64_t>(word) << 8 | std::to_integer<std::uint8_t>(from[i]));
  }
  return std::bit_cast<T>(word);
}

/// Writes the number T into the sizeof(T) bytes at `to`.
template <class T>
void WriteBigEndian(std::byte* to, T value) {
  using Word = typename internal::Word<sizeof(T)>::Type;
  const auto word = std::bit_cast<Word>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    to[i] = static_cast<std::byte>(static_cast<std::uint64_t>(word) >> (8 * (sizeof(T) - 1 - i)) & 0xff);
  }
}

/// The signed integer of `width` bytes (1, 2, 4 or 8) at `from`.
inline std::int64_t ReadInteger(const std::byte* from, std::size_t width) {
  switch (width) {
    case 1:
      return ReadBigEndian<std::int8_t>(from);
    case 2:
      return ReadBigEndian<std::int16_t>(from);
    case 4:
      return ReadBigEndian<std::int32_t>(from);
    default:
      return ReadBigEndian<std::int64_t>(from);
  }
}

/// Writes the low `width` bytes (1, 2, 4 or 8) of `value` to `to`.
inline void WriteInteger(std::byte* to, std::int64_t value, std::size_t width) {
  switch (width) {
    case 1:
      return WriteBigEndian(to, static_cast<std::int8_t>(value));
    case 2:
      return WriteBigEndian(to, static_cast<std::int16_t>(value));
    case 4:
      return WriteBigEndian(to, static_cast<std::int32_t>(value));
    default:
      return WriteBigEndian(to, value);
  }
}

}  // namespace priamos::bus
