#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace priamos::bus::radio {

/// Appends values bit by bit, most significant bit first; the last byte is filled up with zeros.
class BitWriter {
 public:
  /// The lowest `bits` bits of `value`, 0 to 64.
  void Write(std::uint64_t value, int bits) {
    for (int i = bits - 1; i >= 0; --i) Put(((value >> i) & 1U) != 0);
  }
  /// The first `bits` bits of `from`, which holds as many.
  void Append(std::span<const std::byte> from, std::size_t bits) {
    for (std::size_t i = 0; i < bits / 8; ++i) Write(std::to_integer<std::uint64_t>(from[i]), 8);
    const int rest = static_cast<int>(bits % 8);
    if (rest > 0) Write(std::to_integer<std::uint64_t>(from[bits / 8]) >> (8 - rest), rest);
  }
  std::size_t bits() const { return bits_; }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  void Put(bool bit) {
    if (bits_ % 8 == 0) bytes_.push_back(std::byte{0});
    if (bit) bytes_.back() |= std::byte{0x80} >> static_cast<int>(bits_ % 8);
    ++bits_;
  }
  std::vector<std::byte> bytes_;
  std::size_t bits_ = 0;
};

/// Reads what a BitWriter wrote. Reading past the end gives zeros and makes ok() false for good.
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint64_t Read(int bits) {
    std::uint64_t value = 0;
    for (int i = 0; i < bits; ++i) value = value << 1 | (Get() ? 1U : 0U);
    return value;
  }
  /// The next `bits` bits as bytes, the last one filled up with zeros; empty when there are fewer.
  std::vector<std::byte> Take(std::size_t bits) {
    if (bits > left()) {
      ok_ = false;
      return {};
    }
    BitWriter taken;
    for (std::size_t i = 0; i < bits / 8; ++i) taken.Write(Read(8), 8);
    const int rest = static_cast<int>(bits % 8);
    taken.Write(Read(rest), rest);
    return taken.bytes();
  }
  std::size_t left() const { return bytes_.size() * 8 - at_; }
  bool ok() const { return ok_; }

 private:
  bool Get() {
    if (left() == 0) {
      ok_ = false;
      return false;
    }
    const bool bit = (bytes_[at_ / 8] & (std::byte{0x80} >> static_cast<int>(at_ % 8))) != std::byte{0};
    ++at_;
    return bit;
  }
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace priamos::bus::radio
