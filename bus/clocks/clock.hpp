#pragma once

#include "common/time.hpp"

namespace priamos::bus {

/// Source of `now` for one process. Only the shell asks it; cores get time as an argument.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual Time Now() const = 0;
};

/// The monotonic clock, anchored to Unix time when constructed: stamps are readable dates, compare between
/// the processes of one host to the accuracy of the wall clock's last step, and never step themselves.
class MonotonicClock : public Clock {
 public:
  MonotonicClock();
  Time Now() const override;

 private:
  Duration unix_minus_monotonic_;
};

/// The clock of lockstep: it changes only when it is set.
class SimulatedClock : public Clock {
 public:
  explicit SimulatedClock(Time start) : now_(start) {}
  Time Now() const override { return now_; }
  void Set(Time now) { now_ = now; }

 private:
  Time now_;
};

}  // namespace priamos::bus
