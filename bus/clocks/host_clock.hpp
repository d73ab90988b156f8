#pragma once

#include <string_view>

#include "bus/clocks/clock.hpp"
#include "bus/host/clock_anchor.hpp"

namespace priamos::bus {

/// The clock of every process of a host: the time since it was switched on, sleep included, added to one
/// anchor that all agree on. Stamps of two processes compare whenever either was started, also when the wall
/// clock was set in between; no stamp steps. The wall clock's later steps are not followed: they would come
/// at another moment in each process.
class HostClock : public Clock {
 public:
  /// Agrees on the anchor of this host and boot; never throws, see ClockAnchor::problem.
  HostClock();
  explicit HostClock(ClockAnchor anchor) : anchor_(std::move(anchor)) {}

  Time Now() const override;
  const ClockAnchor& anchor() const { return anchor_; }
  /// Names this clock on a bus to which its processes send from `address`. Boot and anchor do not suffice:
  /// machines that were copied while they ran share both, and their clocks drift apart.
  std::int32_t IdAt(std::string_view address) const;
  /// How far the wall clock is ahead of the stamps now.
  Duration WallAhead() const;

 private:
  ClockAnchor anchor_;
};

}  // namespace priamos::bus
