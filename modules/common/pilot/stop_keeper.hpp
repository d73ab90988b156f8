#pragma once

#include <optional>

#include "common/time.hpp"

namespace priamos {

/// An emergency stop that was ordered is repeated every second until the robot reports that it is latched.
class StopKeeper {
 public:
  void Order() {
    ordered_ = true;
    sent_.reset();
  }
  void Forget() { ordered_ = false; }
  bool pending() const { return ordered_; }

  /// Whether a stop is to be sent now. `latched`: as the robot's newest report has it.
  bool Step(bool latched, Time now) {
    if (sent_ && latched) ordered_ = false;
    if (!ordered_ || (sent_ && now - *sent_ < kAgain)) return false;
    sent_ = now;
    return true;
  }

 private:
  static constexpr Duration kAgain{1'000'000};
  bool ordered_ = false;
  std::optional<Time> sent_;
};

}  // namespace priamos
