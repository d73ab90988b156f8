#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace priamos::head {

/// A point of the laser's line in space.
struct LightPoint {
  double u = 0;               ///< its column [px]
  Eigen::Vector3d at;         ///< base frame [m]
  double variance = 0;        ///< variance of its height, from picture and roughness of the surface [m^2]
  int line = 0;               ///< of which laser; points lie line after line
  double laser_variance = 0;  ///< of its height, from what is wrong about its laser's plane [m^2]
};

/// The floor in the base frame: z = plane.dot(1, x, y).
struct FloorPlane {
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  double HeightOf(const Eigen::Vector3d& p) const { return p.z() - plane.dot(Row(p)); }
  /// Variance of the floor's height below a point.
  double VarianceAt(const Eigen::Vector3d& p) const { return Row(p).dot(covariance * Row(p)); }
  static Eigen::Vector3d Row(const Eigen::Vector3d& p) { return {1, p.x(), p.y()}; }
};

/// Number of neighbouring columns that count as one measurement, because they see the same speckle.
inline constexpr double kColumnsPerFact = 5;

/// The floor among the points: the plane within `prior` (covariance of (height, pitch, roll) about a floor at
/// z = 0) that most of them lie on, refined by all that do. Points of obstacles do not affect it. Without
/// points it is the prior. Of several lines each has one voice, however many points it has: a step may carry
/// all of one.
FloorPlane FitFloor(std::span<const LightPoint> points, const Eigen::Matrix3d& prior);

}  // namespace priamos::head
