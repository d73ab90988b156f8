#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::head {

/// One straight edge of a landmark's skeleton, landmark frame [m]. Seen by viewers whose azimuth about the
/// landmark's origin lies in the sector from `visible_from_rad` counter-clockwise to `visible_to_rad`.
struct LandmarkEdge {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();
  double visible_from_rad = -kPi, visible_to_rad = kPi;
  int side = 0;  ///< 0 both, 1 left, 2 right, 3 movable
  /// Logarithm of the ratio of the grey values beside the edge in the image, right over left of its direction
  /// from -> to; nullopt: not known. A ratio, since lighting changes both alike.
  std::optional<double> grey_ratio{};
  double grey_sigma = 0;  ///< of what a look measures about grey_ratio; 0: AssociationOptions::grey_sigma

  /// Part of something that may stand elsewhere, such as a door's leaf.
  bool IsMovable() const { return side == 3; }
  /// Shift along y when the landmark is broader than the model by 1: its sides lie half of it beside its
  /// middle.
  double ByBreadth() const { return side == 1 ? 0.5 : side == 2 ? -0.5 : 0; }
  bool IsVertical() const { return (to - from).head<2>().norm() < 0.01 * std::abs(to.z() - from.z()); }
  /// A fixed edge that lies as high at both ends.
  bool IsLevel() const { return !IsMovable() && std::abs(to.z() - from.z()) < 0.01 * (to - from).norm(); }
  /// Whether a viewer at `in_landmark` is in the sector widened by `margin_rad` at both ends.
  bool IsSeenFrom(const Eigen::Vector2d& in_landmark, double margin_rad = 0) const;
};

/// A landmark as an edge skeleton (paper, section 6.1). Its frame stands on the floor, z up.
struct LandmarkModel {
  int id = 0;
  Pose2 map_from_landmark;
  std::vector<LandmarkEdge> edges;
};

/// A pose on the floor as a transform of space.
inline Eigen::Isometry3d Lift(const Pose2& pose) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.translation() << pose.x, pose.y, 0;
  t.linear() = Eigen::AngleAxisd(pose.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return t;
}

}  // namespace priamos::head
