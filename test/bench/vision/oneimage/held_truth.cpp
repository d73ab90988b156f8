#include "test/bench/vision/oneimage/held_truth.hpp"

#include <cmath>

#include "head/core/calibration/resection/camera_parameters.hpp"
#include "head/core/stand/camera_stand.hpp"

namespace priamos::bench {
namespace {

constexpr double kSameDoor_m = 0.25;

/// Pose of a camera's own frame in the base frame.
Eigen::Isometry3d PoseOf(const head::CameraModel& camera) {
  const auto parameters = head::ExtractParameters(camera.image_from_base);
  Eigen::Isometry3d base_from_camera(Eigen::Translation3d(parameters->centre_m));
  base_from_camera.linear() = parameters->camera_from_base.transpose();
  return base_from_camera;
}

bool IsSeenAs(const head::CameraModel& camera, const TrueDoor& door, double wider_m,
              const head::ImageDoor& reported) {
  const Eigen::Vector2d frame = wider_m * (door.left - door.right).normalized(), left = door.left + frame,
                        right = door.right - frame;
  const Eigen::Vector3d top_left(left.x(), left.y(), door.height_m + wider_m),
      top_right(right.x(), right.y(), door.height_m + wider_m);
  if (camera.Depth(top_left) <= 0 || camera.Depth(top_right) <= 0) return false;
  const Eigen::Vector2d p = camera.Project(top_left), q = camera.Project(top_right);
  const double breadth = std::abs(p.x() - q.x()),
               told = std::abs(reported.corners[0].x() - reported.corners[1].x());
  const auto parameters = head::ExtractParameters(camera.image_from_base);
  const double near_px = kSameDoor_m * parameters->focal_u_px / door.range_m;
  const Eigen::Vector2d off = (p + q - reported.corners[0] - reported.corners[1]) / 2;
  return off.norm() < near_px && told > 0.5 * breadth && told < 1.5 * breadth;
}

}  // namespace

head::CameraModel InFrameOf(const head::CameraModel& own, head::CameraModel camera) {
  camera.image_from_base = (camera.image_from_base * PoseOf(own).matrix()).eval();
  return camera;
}

HeldTruth::HeldTruth(const CorridorLook& look) : look_(look) {
  const Eigen::Isometry3d pose = PoseOf(look.exact[0]);
  const Eigen::Vector3d ahead = pose.linear() * Eigen::Vector3d::UnitZ();
  stand_ = head::StandOf(pose.linear().transpose() * Eigen::Vector3d::UnitZ(), pose.translation().z());
  base_from_camera_ = {pose.translation().x(), pose.translation().y(), std::atan2(ahead.y(), ahead.x())};
}

Pose2 HeldTruth::PlaceOf(const TrueDoor& door) const {
  const Eigen::Vector2d across = door.left - door.right, middle = door.middle();
  return base_from_camera_.Inverse() *
         Pose2{middle.x(), middle.y(), WrapAngle(std::atan2(across.y(), across.x()) - kPi / 2)};
}

const TrueDoor* HeldTruth::Match(const head::ImageDoor& reported) const {
  for (const TrueDoor& door : look_.doors)
    for (const double wider_m : {0.0, door.frame_m})
      if (IsSeenAs(look_.exact[0], door, wider_m, reported)) return &door;
  return nullptr;
}

const TrueDoor* HeldTruth::Match(const head::DetectedDoor& reported) const {
  for (const TrueDoor& door : look_.doors)
    if ((PlaceOf(door).translation() - reported.base_from_door.translation()).norm() < kSameDoor_m)
      return &door;
  return nullptr;
}

}  // namespace priamos::bench
