#include "head/core/calibration/discs/disc_projection.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {

namespace {

constexpr int kRimPoints = 32;

/// The two eigenvalues of a symmetric 2x2 matrix, larger one first.
std::pair<double, double> Eigenvalues(const Eigen::Matrix2d& m) {
  const double mean = m.trace() / 2;
  const double half = std::hypot((m(0, 0) - m(1, 1)) / 2, m(0, 1));
  return {mean + half, std::max(0.0, mean - half)};
}

/// Maps (cos t, sin t, 1) to the homogeneous image of the disc's rim.
Eigen::Matrix3d ImageFromUnitCircle(const Eigen::Matrix<double, 3, 4>& image_from_base,
                                    const ReferenceDisc& disc) {
  const Eigen::Vector3d e1 = disc.normal.unitOrthogonal();
  const Eigen::Vector3d e2 = disc.normal.cross(e1);
  Eigen::Matrix<double, 4, 3> base_from_circle = Eigen::Matrix<double, 4, 3>::Zero();
  base_from_circle.col(0).head<3>() = disc.radius_m * e1;
  base_from_circle.col(1).head<3>() = disc.radius_m * e2;
  base_from_circle.col(2) = disc.centre_m.homogeneous();
  return image_from_base * base_from_circle;
}

const std::array<Eigen::Vector2d, kRimPoints>& Directions() {
  static const auto kDirections = [] {
    std::array<Eigen::Vector2d, kRimPoints> directions;
    for (int i = 0; i < kRimPoints; ++i) {
      directions[i] = {std::cos(2 * kPi * i / kRimPoints), std::sin(2 * kPi * i / kRimPoints)};
    }
    return directions;
  }();
  return kDirections;
}

/// The centroid of the polygon of the ellipse's rim after distortion. The polygon of an undistorted ellipse
/// has exactly its centre, so few points are enough for the small change that the lens makes.
Eigen::Vector2d DistortedCentroid(const CameraModel& camera, const Ellipse& ellipse) {
  const Eigen::Matrix2d root = ellipse.shape_px2.llt().matrixL();
  const Eigen::Vector2d origin = camera.Distort(ellipse.centre_px);
  const auto rim = [&](int i) -> Eigen::Vector2d {
    return camera.Distort(ellipse.centre_px + root * Directions()[i]) - origin;
  };
  double twice_area = 0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  Eigen::Vector2d previous = rim(kRimPoints - 1);
  for (int i = 0; i < kRimPoints; ++i) {
    const Eigen::Vector2d next = rim(i);
    const double cross = previous.x() * next.y() - previous.y() * next.x();
    twice_area += cross;
    moment += cross * (previous + next);
    previous = next;
  }
  return origin + moment / (3 * twice_area);
}

}  // namespace

double Ellipse::SemiMajor() const {
  return std::sqrt(Eigenvalues(shape_px2).first);
}
double Ellipse::SemiMinor() const {
  return std::sqrt(Eigenvalues(shape_px2).second);
}
double Ellipse::Area() const {
  return kPi * std::sqrt(std::max(0.0, shape_px2.determinant()));
}

std::optional<Ellipse> ProjectDisc(const Eigen::Matrix<double, 3, 4>& image_from_base,
                                   const ReferenceDisc& disc) {
  const Eigen::Matrix3d h = ImageFromUnitCircle(image_from_base, disc);
  const Eigen::RowVector3d depth = h.row(2);
  if (depth(2) <= depth.head<2>().norm()) return std::nullopt;
  Eigen::Matrix3d dual = h * Eigen::Vector3d(1, 1, -1).asDiagonal() * h.transpose();
  dual /= -dual(2, 2);
  Ellipse ellipse;
  ellipse.centre_px = -dual.topRightCorner<2, 1>();
  ellipse.shape_px2 = dual.topLeftCorner<2, 2>() + ellipse.centre_px * ellipse.centre_px.transpose();
  const bool usable = ellipse.shape_px2(0, 0) > 0 && ellipse.shape_px2.determinant() > 1e-9;
  return usable ? std::optional(ellipse) : std::nullopt;
}

std::optional<Eigen::Vector2d> ProjectDiscCentroid(const CameraModel& camera, const ReferenceDisc& disc) {
  const std::optional<Ellipse> ellipse = ProjectDisc(camera.image_from_base, disc);
  if (!ellipse) return std::nullopt;
  const bool undistorted = camera.k1 == 0 && camera.k2 == 0;
  return undistorted ? ellipse->centre_px : DistortedCentroid(camera, *ellipse);
}

Eigen::Vector2d CentroidBias(const CameraModel& camera, const ReferenceDisc& disc) {
  const std::optional<Eigen::Vector2d> centroid = ProjectDiscCentroid(camera, disc);
  if (!centroid) return Eigen::Vector2d::Zero();
  return *centroid - camera.Distort(camera.Project(disc.centre_m));
}

}  // namespace priamos::head
