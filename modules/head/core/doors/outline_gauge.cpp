#include "head/core/doors/outline_gauge.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr double kStep_px = 0.05, kStep_rad = 1e-4;  ///< for derivatives

using Seen = Eigen::Matrix<double, 6, 1>;  ///< corners left, right [px], tilt, roll [rad]

/// Yaw, width and range.
Eigen::Vector3d Gauge(const CameraModel& camera, const Seen& seen) {
  const CameraModel level = OnTheFloor(camera, {0, seen[4], seen[5]});
  const Eigen::Matrix3d rays = level.image_from_base.leftCols<3>().inverse();
  Eigen::Matrix2d at;
  for (Eigen::Index side = 0; side < 2; ++side) {
    const Eigen::Vector3d ray = rays * seen.segment<2>(2 * side).homogeneous();
    at.col(side) = ray.head<2>() / ray.z();
  }
  const Eigen::Vector2d across = at.col(0) - at.col(1), middle = (at.col(0) + at.col(1)) / 2;
  return {WrapAngle(std::atan2(across.y(), across.x()) - kPi / 2), across.norm(), middle.norm()};
}

}  // namespace

OutlineGauge GaugeOutline(const DoorOutline& outline, const CameraModel& camera, const CameraStand& stand,
                          const Eigen::Matrix2d& covariance, double corner_sigma_px) {
  Seen seen;
  seen << outline.corners[0], outline.corners[1], stand.tilt_rad, stand.roll_rad;
  const Eigen::Vector3d gauged = Gauge(camera, seen);
  Eigen::Matrix<double, 3, 6> j;
  for (int k = 0; k < 6; ++k) {
    const double step = k < 4 ? kStep_px : kStep_rad;
    Seen moved = seen;
    moved[k] += step;
    j.col(k) = (Gauge(camera, moved) - gauged) / step;
    j(0, k) = WrapAngle(j(0, k) * step) / step;
  }
  Eigen::Matrix<double, 6, 6> noise = Eigen::Matrix<double, 6, 6>::Zero();
  noise.diagonal().head<4>().setConstant(corner_sigma_px * corner_sigma_px);
  noise.bottomRightCorner<2, 2>() = covariance;
  const Eigen::Vector3d sigma = (j * noise * j.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
  return {gauged[0], gauged[1], gauged[2], sigma[0], sigma[1], sigma[2]};
}

}  // namespace priamos::head
