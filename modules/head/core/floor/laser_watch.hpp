#pragma once

#include <cstdint>
#include <optional>

#include "common/archive.hpp"
#include "common/image_size.hpp"
#include "common/time.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/frame_notice.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/camera/head_setting.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/camera/picture_order.hpp"
#include "head/core/floor/obstacle_options.hpp"

namespace priamos::head {

/// Settings of when the third camera watches the lines of the lasers.
struct LaserWatchConfig {
  double rate_hz = 0;    ///< pictures of the lines; 0: none, the head stays where it was
  double tilt_deg = 31;  ///< tilt of a head that nobody needs: the third camera must see the lines
  double idle_s = 1;     ///< time after a look, or an operator's motion, until the head turns down
  ObstacleOptions obstacle;

  void Describe(Archive& a);
};

/// What the watch goes by, at one moment.
struct WatchMoment {
  bool needed = false;    ///< a look or an operator moves the head, or may do so at once
  bool sees = false;      ///< it rests where the camera sees a line
  bool sees_all = false;  ///< and those of all lasers
  bool exposing = false;  ///< a look's pictures are being taken
};

/// Sequence of orders for watching the lines: pictures are taken wherever the head rests with a line in view,
/// also between and during looks, which they do not delay. When nobody needs it, the head turns down to see
/// all of them. Looks and operators take the head at once.
class LaserWatch {
 public:
  explicit LaserWatch(const LaserWatchConfig& config) : config_(config) {}

  /// What to do now, see Step.
  enum class Action { kWait, kLower, kTrigger };
  /// One time step. kLower means: turn the head down; kTrigger: expose the third camera with the lasers on,
  /// as frame_id(). `here` is where the head rests.
  Action Step(const WatchMoment& moment, const HeadSetting& here, Time now);
  /// A report of the motors.
  void Report(const HeadSetting& setting, bool moving, Time time);
  /// Where the head rested while this picture was exposed, if it is the one that was ordered last; once.
  /// nullopt also where the head left before the exposure was over.
  std::optional<HeadSetting> Takes(const FrameNotice& frame);
  std::int32_t frame_id() const { return picture_.frame_id(); }

 private:
  bool MayLower(Time now) const;

  LaserWatchConfig config_;
  std::optional<Time> idle_since_, lowered_, triggered_;
  PictureOrder picture_{0x40000000};
  HeadSetting at_;       ///< where the last picture was ordered
  Time rested_until_{};  ///< the head was there until then
  bool rests_ = false;   ///< and has not left
};

/// Whether the camera shows enough of the line on a level floor, inside its picture: a head that is turned
/// aside sees one end.
bool SeesLine(const CameraModel& camera, const LaserPlane& laser, const ImageSize& picture);
/// Number of lines that the third camera shows at a setting; 0 without a calibrated laser or camera.
std::size_t LinesSeen(const HeadModel& head, const HeadSetting& setting);

}  // namespace priamos::head
