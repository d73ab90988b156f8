#pragma once

#include <cstdint>
#include <optional>

#include "common/time.hpp"
#include "head/core/camera/frame_notice.hpp"
#include "head/core/camera/picture_order.hpp"

namespace priamos::head {

/// When the third camera is exposed for people who look on: at a steady rate while somebody does, and never
/// while a look uses the cameras.
class VideoRhythm {
 public:
  explicit VideoRhythm(double rate_hz) : rate_hz_(rate_hz) {}

  /// One time step; true: expose the third camera as frame_id().
  bool Step(bool watched, bool needed, Time now);
  /// Whether this is the picture that was ordered last; true once.
  bool Takes(const FrameNotice& frame) { return picture_.Takes(frame); }
  std::int32_t frame_id() const { return picture_.frame_id(); }

 private:
  double rate_hz_;
  std::optional<Time> triggered_;
  PictureOrder picture_{0x50000000};
};

}  // namespace priamos::head
