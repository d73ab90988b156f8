#include "head/core/look/video_rhythm.hpp"

#include "head/core/camera/head_model.hpp"

namespace priamos::head {
namespace {

constexpr std::int32_t kFirstFrame = 0x50000000;  // looks count from 1, the laser's pictures from 0x40000000
constexpr double kLost_s = 1;                     ///< a picture that has not come by then does not come

}  // namespace

bool VideoRhythm::Step(bool watched, bool needed, Time now) {
  if (!watched || needed) return false;
  const double since_s = triggered_ ? Seconds(now - *triggered_) : kLost_s;
  if (since_s < 1 / rate_hz_ || (waiting_ && since_s < kLost_s)) return false;
  triggered_ = now;
  waiting_ = true;
  frame_id_ = frame_id_ == 0 || frame_id_ == kFirstFrame + 0xFFFF ? kFirstFrame : frame_id_ + 1;
  return true;
}

bool VideoRhythm::Takes(const FrameNotice& frame) {
  if (!waiting_ || frame.frame_id != frame_id_ || frame.camera != kThird) return false;
  waiting_ = false;
  return true;
}

}  // namespace priamos::head
