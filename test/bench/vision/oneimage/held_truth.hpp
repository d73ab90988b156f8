#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "head/core/doors/door_detection.hpp"
#include "head/core/doors/image_doors.hpp"
#include "test/bench/vision/corridor_looks.hpp"

namespace priamos::bench {

/// `camera` in the frame of `own` itself (x right, y down, z forward), as one knows it without a stand.
head::CameraModel InFrameOf(const head::CameraModel& own, head::CameraModel camera);

/// How the left camera of a look really stands, and its doors in that camera's base frame (on the floor
/// below it, x where it looks).
class HeldTruth {
 public:
  explicit HeldTruth(const CorridorLook& look);

  const head::CameraStand& stand() const { return stand_; }
  /// Place of a door on the floor; x away from the camera.
  Pose2 PlaceOf(const TrueDoor& door) const;
  /// The door that was reported: its middle between the upper corners within 25 cm at the door's distance,
  /// and half to one and a half times as broad in the image; nullptr: none.
  const TrueDoor* Match(const head::ImageDoor& reported) const;
  const TrueDoor* Match(const head::DetectedDoor& reported) const;

 private:
  const CorridorLook& look_;
  head::CameraStand stand_;
  Pose2 base_from_camera_;  ///< on the floor: where the camera stands in the robot's base frame and looks
};

}  // namespace priamos::bench
