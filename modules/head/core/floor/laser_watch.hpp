#pragma once

#include <cstdint>
#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/frame_notice.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/camera/picture_order.hpp"
#include "head/core/floor/obstacle_lines.hpp"

namespace priamos::head {

/// Settings of when the third camera watches the laser's line.
struct LaserWatchConfig {
  double rate_hz = 0;    ///< pictures of the line; 0: none, the head stays where it was
  double tilt_deg = 36;  ///< tilt of the head meanwhile: the third camera must see the line
  double idle_s = 1;     ///< time after a look, or an operator's motion, until the head turns down
  ObstacleOptions obstacle;

  void Describe(Archive& a);
};

/// Sequence of orders for watching the line: the head turns down when it is not needed for anything else, and
/// pictures are taken while it rests there. Looks and operators take the head at once.
class LaserWatch {
 public:
  explicit LaserWatch(const LaserWatchConfig& config) : config_(config) {}

  /// What to do now, see Step.
  enum class Action { kWait, kLower, kTrigger };
  /// One time step. `needed`: a look or an operator moves the head; `sees`: it rests where the camera sees
  /// the line. kLower means: turn it down; kTrigger: expose the third camera with the laser on, as
  /// frame_id().
  Action Step(bool needed, bool sees, Time now);
  /// Whether this is the picture that was ordered last; true once.
  bool Takes(const FrameNotice& frame) { return picture_.Takes(frame); }
  std::int32_t frame_id() const { return picture_.frame_id(); }

 private:
  LaserWatchConfig config_;
  std::optional<Time> idle_since_, lowered_, triggered_;
  PictureOrder picture_{0x40000000};
};

/// Whether the camera shows the middle of the line on a level floor, well inside its picture.
bool SeesLine(const CameraModel& camera, const LaserPlane& laser, int width, int height);
/// Whether the third camera does at a setting; not without a calibrated laser or camera.
bool SeesLine(const HeadModel& head, const HeadSetting& setting);

}  // namespace priamos::head
