#pragma once

#include <cstdint>

namespace priamos::bus::radio {

/// The counters of one direction that were used. A counter is fresh until it is used; one older than the
/// window is never fresh. The window (64) only matters on links that reorder, such as UDP.
class ReplayWindow {
 public:
  /// All counters up to `floor` count as used.
  explicit ReplayWindow(std::uint64_t floor = 0) : highest_(floor) {}

  bool Fresh(std::uint64_t counter) const {
    if (counter > highest_) return true;
    const std::uint64_t back = highest_ - counter;
    return back < 64 && (used_ >> back & 1U) == 0;
  }
  void Use(std::uint64_t counter) {
    if (counter > highest_) {
      const std::uint64_t ahead = counter - highest_;
      used_ = ahead < 64 ? used_ << ahead : 0;
      highest_ = counter;
    }
    used_ |= std::uint64_t{1} << (highest_ - counter);
  }
  std::uint64_t highest() const { return highest_; }

  /// The counter whose lowest 7 bits are `low`, from 31 below the highest used one to 96 above it.
  std::uint64_t Reconstruct(std::uint8_t low) const {
    const std::uint64_t first = highest_ < 31 ? 0 : highest_ - 31;
    return first + ((low - first) & 0x7F);
  }

 private:
  std::uint64_t highest_;
  std::uint64_t used_ = ~std::uint64_t{0};
};

}  // namespace priamos::bus::radio
