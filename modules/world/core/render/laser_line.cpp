#include "world/core/render/laser_line.hpp"

#include <cmath>

#include "world/core/camera/optics.hpp"

namespace priamos::world {

namespace {

using Eigen::Vector3d;

constexpr int kRays = 1200;
constexpr double kReach_m = 8;
constexpr double kLift_m = 0.0002;  // over the surface, for the depth buffer

/// Half of the strip's width, within the surface and across the plane of the light.
Vector3d HalfWidth(const Vector3d& plane_normal, const Vector3d& surface_normal, double thickness) {
  const Vector3d within = plane_normal - plane_normal.dot(surface_normal) * surface_normal;
  const double length2 = within.squaredNorm();
  return length2 > 1e-6 ? Vector3d(within * (thickness / 2 / length2)) : Vector3d(Vector3d::Zero());
}

MeshVertex Shining(const Vector3d& p) {
  return {float(p.x()), float(p.y()), float(p.z()), 0, 0, 0, 0.5F, 0, 1};
}

void AppendStrip(const Vector3d& a, const Vector3d& b, const Vector3d& half, const Vector3d& normal,
                 Mesh& mesh) {
  MeshVertex c[] = {Shining(a - half), Shining(b - half), Shining(b + half), Shining(a + half)};
  if ((b - a).cross(half).dot(normal) < 0) std::swap(c[1], c[3]);
  mesh.push_back({c[0], c[1], c[2]});
  mesh.push_back({c[0], c[2], c[3]});
}

}  // namespace

void AppendLaser(const LaserBuild& laser, const Pose2& map_from_base, const Lighting& surfaces, Mesh& mesh) {
  const Eigen::Isometry3d map_from_fan = Lift(map_from_base) * laser.BaseFromFan();
  const Vector3d origin = map_from_fan.translation(), plane_normal = map_from_fan.linear().col(2);
  RayHit last;
  Vector3d last_point;
  for (int i = 0; i <= kRays; ++i) {
    const double angle = laser.half_angle_rad * (2.0 * i / kRays - 1);
    const Vector3d ray = map_from_fan.linear() * Vector3d(std::cos(angle), std::sin(angle), 0);
    const RayHit hit = surfaces.Trace(origin, ray, kReach_m);
    const Vector3d point = origin + hit.distance_m * ray + kLift_m * hit.normal;
    const bool same_face =
        i > 0 && hit.solid == last.solid && hit.normal == last.normal && hit.solid != kNothing && !hit.mirror;
    if (same_face) {
      AppendStrip(last_point, point, HalfWidth(plane_normal, hit.normal, laser.thickness_m), hit.normal,
                  mesh);
    }
    last = hit;
    last_point = point;
  }
}

}  // namespace priamos::world
