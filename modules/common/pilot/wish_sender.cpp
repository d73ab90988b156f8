#include "common/pilot/wish_sender.hpp"

namespace priamos {

bool WishSender::Step(Stick stick, bool jumped, Time now) {
  if (stick == Stick::kDeflected) {
    if (zeros_left_ == kZeros && !Due(jumped ? period_ / 2 : period_, now)) return false;
    zeros_left_ = kZeros;
    return Sent(now);
  }
  if (zeros_left_ > 0 && (zeros_left_ == kZeros || Due(period_, now))) {
    --zeros_left_;
    return Sent(now);
  }
  return stick == Stick::kHeld && Due(rest_period_, now) && Sent(now);
}

bool WishSender::Due(Duration period, Time now) const {
  return !last_ || now - *last_ >= period;
}

bool WishSender::Sent(Time now) {
  last_ = now;
  return true;
}

}  // namespace priamos
