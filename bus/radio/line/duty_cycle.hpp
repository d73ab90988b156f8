#pragma once

#include <algorithm>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// Share of the time that a radio may be on the air, in any window of a length that the law names. By the
/// generic cell rate algorithm: an ordinary frame waits until all before it are paid for; an urgent one goes
/// on credit. Both together stay within the share: what is paid per second is less than it, by what the
/// credit and a frame that has just begun can add to a window.
class DutyCycle {
 public:
  /// By default the air is free.
  DutyCycle() = default;
  /// At most `share` of 0..1 of any `window`.
  DutyCycle(double share, Duration window)
      : rate_(share < 1 ? share / (1 + kCreditPart + kFramePart) : 1),
        credit_(FromSeconds(share < 1 ? Seconds(window) * kCreditPart : 0)),
        longest_(FromSeconds(Seconds(window) * share / (1 + kCreditPart + kFramePart) * kFramePart)) {}

  bool limited() const { return rate_ < 1; }
  /// Share of the time for ordinary frames in the long run.
  double rate() const { return rate_; }
  /// Time on air that urgent frames can take at once.
  Duration credit() const { return FromSeconds(Seconds(credit_) * rate_); }
  /// Longest frame for which the share is kept.
  Duration longest() const { return longest_; }
  /// Whether a frame may begin now.
  bool Allows(Time now, bool urgent) const {
    return !limited() || paid_until_ <= now + (urgent ? credit_ : Duration::zero());
  }
  /// Charges a frame that begins now.
  void Use(Time now, Duration on_air) {
    if (limited()) paid_until_ = std::max(paid_until_, now) + FromSeconds(Seconds(on_air) / rate_);
  }

 private:
  static constexpr double kCreditPart = 0.1;
  static constexpr double kFramePart = 0.1;
  double rate_ = 1;
  Duration credit_{};
  Duration longest_{};
  Time paid_until_ = Time::min();
};

}  // namespace priamos::bus::radio
