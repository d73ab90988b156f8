#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "common/time.hpp"

namespace priamos::bus {

/// Notices that the clock of another host has stepped, from the ages of its messages: the time from a stamp,
/// translated into our clock, to the arrival. When a clock steps forward, stamps come out of the future,
/// which no delay explains. When it steps back (a virtual machine that was paused), every message is older at
/// once than any of its kind was of late; that a delay explains as well, so it is a reason to ask, not to
/// know. Pure.
class AgeWatch {
 public:
  /// What the age of a message says of the clock that stamped it.
  enum class Verdict : std::uint8_t {
    kUsual,
    kFuture,  ///< younger than now by more than is uncertain: no clock that was measured rightly stamps so
    kOlder,   ///< by more than kJump older than all of its kind in the last kRemembered
  };
  static constexpr Duration kJump{20'000}, kRemembered{10'000'000};
  /// Senders' channels that are watched; of more, none new.
  static constexpr std::size_t kMostKinds = 512;

  /// A message of `age`, of which up to `waited` may have passed here, before it was read; the difference
  /// of the clocks is known to `uncertainty`.
  Verdict Judge(std::uint64_t sender, std::string_view channel, Duration age, Duration uncertainty,
                Duration waited) const;
  /// Such an age is usual from now on.
  void Note(std::uint64_t sender, std::string_view channel, Duration age, Time now);

 private:
  /// The oldest of the present half of kRemembered, and of the one before.
  struct Ages {
    Time since{};
    Duration oldest{}, oldest_before{};
  };
  std::map<std::pair<std::uint64_t, std::string>, Ages, std::less<>> kinds_;
};

}  // namespace priamos::bus
