#pragma once

#include <algorithm>

#include "common/time.hpp"

namespace priamos::radio {

/// When a message may have come at the earliest. What waits in a socket while the process is stopped, or its
/// machine suspended, is older than it looks.
class PauseWatch {
 public:
  /// Watch of a process that has time for its messages at least every `period`.
  PauseWatch(Duration period, Time now)
      : gap_(2 * period + kJitter), last_(now), asleep_from_(now), woke_(now) {}

  /// Notes that the process has time; to be called every period.
  void Tick(Time now) {
    if (now - last_ > gap_) {
      asleep_from_ = last_;
      woke_ = now;
    }
    last_ = now;
  }
  /// Time at which a message that is read `now` came, or later. Whether messages or Tick() come first after a
  /// pause is not known.
  Time CameAt(Time now) const {
    if (now - last_ > gap_) return last_;
    return now - woke_ <= gap_ ? std::min(asleep_from_, now) : now;
  }

 private:
  static constexpr Duration kJitter{8000};
  Duration gap_;
  Time last_, asleep_from_, woke_;
};

}  // namespace priamos::radio
