#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// Limits of what is a point of the light before the robot [m].
inline constexpr double kNearestLight_m = 0.2, kFarthestLight_m = 8;

/// The light plane of the line laser in the base frame. The laser is mounted on the robot, not on the head,
/// so the plane does not depend on the head's setting.
struct LaserPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit normal of the plane
  double offset_m = 0;  ///< normal.dot(p) + offset_m = 0 for points in the light
  Eigen::Vector3d pivot_m = Eigen::Vector3d::Zero();  ///< middle of the points it was calibrated with
  /// Standard deviations: of a turn about the pivot (the worse axis), and of the pivot along the normal.
  double sigma_turn_rad = 0, sigma_shift_m = 0;

  Eigen::Hyperplane<double, 3> Plane() const { return {normal, offset_m}; }
  /// How far straight ahead of the base centre its light meets a level floor [m]; infinite or not a number
  /// where it meets none.
  double FloorAhead_m() const { return -offset_m / normal.x(); }
  /// Whether that is from kNearestLight_m to kFarthestLight_m.
  bool MeetsFloorAhead() const {
    return FloorAhead_m() >= kNearestLight_m && FloorAhead_m() <= kFarthestLight_m;
  }
  /// Light plane in the frame of a camera (x right, y down, z forward) at this pose.
  Eigen::Hyperplane<double, 3> InCamera(const Eigen::Isometry3d& base_from_camera) const;
};

/// The point of a plane that a camera shows in a pixel [distorted px]; nullopt for a plane seen edge-on or
/// behind the camera.
std::optional<Eigen::Vector3d> PointOnPlane(const CameraModel& camera, const Eigen::Vector2d& image_px,
                                            const Eigen::Hyperplane<double, 3>& plane);

}  // namespace priamos::head
