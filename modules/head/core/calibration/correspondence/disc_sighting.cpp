#include "head/core/calibration/correspondence/disc_sighting.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "common/principal_axes.hpp"

namespace priamos::head {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Sighting SightDisc(const Ellipse& e, double focal_px, const Vector2d& centre_px) {
  const Vector3d direction = ((e.centre_px - centre_px) / focal_px).homogeneous();
  Sighting s;
  s.ray = direction.normalized();
  const Vector3d right = Vector3d(-s.ray.y(), s.ray.x(), 0).norm() > 1e-6
                             ? s.ray.cross(Vector3d::UnitY()).cross(s.ray).cross(s.ray)
                             : Vector3d(Vector3d::UnitX());
  const Vector3d e1 = (right - right.dot(s.ray) * s.ray).normalized(), e2 = s.ray.cross(e1);
  // From the image plane to the plane across the ray: removes the stretch towards the image border.
  Eigen::Matrix2d across;
  across << e1.head<2>().transpose(), e2.head<2>().transpose();
  across /= direction.norm() * focal_px;
  const PrincipalAxes<2> outline = PrincipalAxesOf<2>(across * e.shape_px2 * across.transpose());
  s.angular_radius = std::sqrt(outline.values(1));
  const double ratio = std::sqrt(std::max(0.0, outline.values(0))) / s.angular_radius;
  const auto axis = [&](int i) -> Vector3d { return outline.axes(0, i) * e1 + outline.axes(1, i) * e2; };
  const auto tilted = [&](double tilt, const Vector3d& towards) -> Vector3d {
    return -std::cos(tilt) * s.ray + std::sin(tilt) * towards;
  };
  const double tilt = std::acos(std::min(1.0, ratio));
  if (tilt < Radians(22)) {
    // Too round to determine in which direction it is tilted.
    s.normals = {tilted(0, axis(0)), tilted(Radians(15), axis(0)), tilted(-Radians(15), axis(0)),
                 tilted(Radians(15), axis(1)), tilted(-Radians(15), axis(1))};
  } else {
    s.normals = {tilted(tilt, axis(0)), tilted(-tilt, axis(0))};
  }
  return s;
}

Matrix3d NormalAxes(const Vector3d& normal, const Vector3d& up) {
  Vector3d across = up - up.dot(normal) * normal;
  if (across.norm() < 0.1) across = normal.unitOrthogonal();
  across.normalize();
  return (Matrix3d() << normal, across, normal.cross(across)).finished();
}

}  // namespace priamos::head
