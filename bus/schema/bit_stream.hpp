#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace priamos::bus {

/// Bits needed for the codes 0..last.
constexpr int BitsFor(std::uint64_t last) {
  return std::bit_width(last);
}

/// Appends numbers of 0..64 bits, most significant bit first; the last byte is filled with zeros.
class BitWriter {
 public:
  explicit BitWriter(std::size_t expected_bytes = 0) { bytes_.reserve(expected_bytes); }

  /// The low `bits` bits of `value`; the bits above them have to be 0.
  void Put(std::uint64_t value, int bits) {
    if (bits > 32) {
      PutShort(value >> 32, bits - 32);
      value &= 0xffffffffU;
      bits = 32;
    }
    PutShort(value, bits);
  }

  std::vector<std::byte> Finish() {
    if (held_bits_ > 0) PutShort(0, 8 - held_bits_);
    return std::move(bytes_);
  }

 private:
  void PutShort(std::uint64_t value, int bits) {
    held_ = held_ << bits | value;
    held_bits_ += bits;
    while (held_bits_ >= 8) {
      held_bits_ -= 8;
      bytes_.push_back(static_cast<std::byte>(held_ >> held_bits_ & 0xff));
    }
  }

  std::vector<std::byte> bytes_;
  std::uint64_t held_ = 0;  // fewer than 8 bits of it are not in bytes_ yet
  int held_bits_ = 0;
};

/// Reads what BitWriter wrote. Reading over the end gives zeros and makes ok() false for good.
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint64_t Get(int bits) {
    if (bits <= 32) return GetShort(bits);
    const std::uint64_t high = GetShort(bits - 32);
    return high << 32 | GetShort(32);
  }

  bool ok() const { return ok_; }
  /// Bytes touched so far.
  std::size_t bytes_used() const { return next_; }
  /// True when only the zeros that fill the last byte are left of the bytes touched.
  bool FillIsZero() const { return (held_ & ((std::uint64_t{1} << held_bits_) - 1)) == 0; }

 private:
  std::uint64_t GetShort(int bits) {
    while (held_bits_ < bits) {
      if (next_ == bytes_.size()) {
        ok_ = false;
        return 0;
      }
      held_ = held_ << 8 | std::to_integer<std::uint64_t>(bytes_[next_++]);
      held_bits_ += 8;
    }
    held_bits_ -= bits;
    return held_ >> held_bits_ & ((std::uint64_t{1} << bits) - 1);
  }

  std::span<const std::byte> bytes_;
  std::size_t next_ = 0;
  std::uint64_t held_ = 0;
  int held_bits_ = 0;
  bool ok_ = true;
};

}  // namespace priamos::bus
