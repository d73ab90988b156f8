#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/time.hpp"

namespace priamos::console {

/// Numbers the moments at which pages were sent something. A page repeats the newest number that it received,
/// which bounds the age of what it says from above by this end's clock alone: what waited somewhere on the
/// way and arrives late cannot pass for fresh.
class Beats {
 public:
  /// The next beat, at `now`; its number.
  std::int64_t Next(Time now) {
    times_[Slot(++newest_)] = now;
    return newest_;
  }
  /// Upper bound of the age of something that names `beat`; Duration::max() for one that was never sent or is
  /// forgotten.
  Duration AgeOf(std::int64_t beat, Time now) const {
    if (beat < 1 || beat > newest_ || beat + static_cast<std::int64_t>(kKept) <= newest_)
      return Duration::max();
    return now - times_[Slot(beat)];
  }

 private:
  static constexpr std::size_t kKept = 64;
  static std::size_t Slot(std::int64_t beat) { return static_cast<std::size_t>(beat) % kKept; }

  std::int64_t newest_ = 0;
  std::array<Time, kKept> times_{};
};

}  // namespace priamos::console
