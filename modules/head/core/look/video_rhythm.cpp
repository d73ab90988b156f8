#include "head/core/look/video_rhythm.hpp"

namespace priamos::head {
namespace {

constexpr double kLost_s = 1;  ///< a picture that has not come by then does not come

}  // namespace

bool VideoRhythm::Step(bool watched, bool needed, Time now) {
  if (!watched || needed) return false;
  const double since_s = triggered_ ? Seconds(now - *triggered_) : kLost_s;
  if (since_s < 1 / rate_hz_ || (picture_.awaited() && since_s < kLost_s)) return false;
  triggered_ = now;
  picture_.Order();
  return true;
}

}  // namespace priamos::head
