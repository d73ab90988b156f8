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

/// Bits in the making: numbers of 0..64 bits, most significant bit first; the last byte is filled with zeros.
class BitWriter {
 public:
  explicit BitWriter(std::size_t expected_bytes = 0) { bytes_.reserve(expected_bytes); }

  /// Appends the low `bits` bits of `value`.
  void Put(std::uint64_t value, int bits) {
    if (bits > 32) {
      PutShort(value >> 32, bits - 32);
      bits = 32;
    }
    PutShort(value, bits);
  }
  /// Appends the first `bits` bits of `from`, which holds as many.
  void Append(std::span<const std::byte> from, std::size_t bits) {
    for (std::size_t i = 0; i < bits / 8; ++i) PutShort(std::to_integer<std::uint64_t>(from[i]), 8);
    const int rest = static_cast<int>(bits % 8);
    if (rest > 0) PutShort(std::to_integer<std::uint64_t>(from[bits / 8]) >> (8 - rest), rest);
  }

  /// Number of bits so far.
  std::size_t bits() const { return 8 * bytes_.size() + static_cast<std::size_t>(held_bits_); }
  /// A copy of the bytes so far.
  std::vector<std::byte> bytes() const { return BitWriter(*this).Finish(); }
  /// The bytes; the writer is used up.
  std::vector<std::byte> Finish() {
    if (held_bits_ > 0) PutShort(0, 8 - held_bits_);
    return std::move(bytes_);
  }

 private:
  void PutShort(std::uint64_t value, int bits) {
    held_ = held_ << bits | (value & ((std::uint64_t{1} << bits) - 1));
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

/// Bits that a BitWriter wrote. Reading over the end gives zeros and makes ok() false for good.
class BitReader {
 public:
  /// Reader that begins at the first bit of `bytes`, which must outlive it.
  explicit BitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  explicit BitReader(std::vector<std::byte>&& bytes) = delete;

  /// The next number of 0..64 bits.
  std::uint64_t Get(int bits) {
    if (bits <= 32) return GetShort(bits);
    const std::uint64_t high = GetShort(bits - 32);
    return high << 32 | GetShort(32);
  }
  /// The next `bits` bits as bytes, the last one filled with zeros; empty when fewer are left.
  std::vector<std::byte> Take(std::size_t bits) {
    if (bits > left()) {
      ok_ = false;
      return {};
    }
    BitWriter taken((bits + 7) / 8);
    for (std::size_t i = 0; i < bits / 8; ++i) taken.Put(GetShort(8), 8);
    const int rest = static_cast<int>(bits % 8);
    taken.Put(GetShort(rest), rest);
    return taken.Finish();
  }

  /// Number of bits not read yet.
  std::size_t left() const { return 8 * (bytes_.size() - next_) + static_cast<std::size_t>(held_bits_); }
  bool ok() const { return ok_; }
  /// Number of bytes touched so far.
  std::size_t bytes_used() const { return next_; }
  /// Whether only the zeros that fill the last byte are left of the bytes touched.
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
