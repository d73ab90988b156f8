#include "world/core/render/lighting.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "common/geometry.hpp"

namespace priamos::world {

namespace {

using Eigen::Vector3d;

constexpr double kSkin_m = 1e-3;         // a ray leaves its surface by this much before it can hit
constexpr double kAmbientReach_m = 1.2;  // things farther away do not shade the ambient light
constexpr int kAmbientRays = 16;
constexpr double kLampReach_m = 6.0, kLampSize_m = 1.0;
constexpr double kLampPower = 18;  // makes a wall between two lamps about 1

/// Directions about +z, denser around it as the cosine law weighs them.
std::array<Vector3d, kAmbientRays> CosineDirections() {
  std::array<Vector3d, kAmbientRays> directions;
  for (int i = 0; i < kAmbientRays; ++i) {
    const double sin2 = (i + 0.5) / kAmbientRays, azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(sin2);
    directions[i] = {r * std::cos(azimuth), r * std::sin(azimuth), std::sqrt(1 - sin2)};
  }
  return directions;
}

/// Entry distance of a ray into the box |x_i| <= half_i and the axis of the face; a ray that starts inside
/// does not see the box.
double Entry(const Vector3d& origin, const Vector3d& direction, const Vector3d& half, int& axis) {
  double near = -1e9, far = 1e9;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) < 1e-12) {
      if (std::abs(origin[i]) > half[i]) return -1;
      continue;
    }
    const double inverse = 1 / direction[i];
    const double a = (-half[i] - origin[i]) * inverse, b = (half[i] - origin[i]) * inverse;
    if (std::min(a, b) > near) {
      near = std::min(a, b);
      axis = i;
    }
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? near : -1;
}

}  // namespace

Lighting::Lighting(const SceneConfig& config, const std::vector<Solid>& solids) : config_(config) {
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Solid& s = solids[i];
    if (IsGlass(s.material)) continue;
    const double half_z = (s.z_max_m - s.z_min_m) / 2;
    boxes_.push_back({std::cos(s.map_from_solid.yaw),
                      std::sin(s.map_from_solid.yaw),
                      {s.map_from_solid.x, s.map_from_solid.y, s.z_min_m + half_z},
                      {s.size_m.x() / 2, s.size_m.y() / 2, half_z},
                      static_cast<int>(i),
                      IsMirror(s.material)});
  }
  std::vector<PlanIndex::Disc> discs;
  discs.reserve(boxes_.size());
  for (const Box& box : boxes_) discs.push_back({box.centre.head<2>(), box.half.norm()});
  index_ = PlanIndex(discs);
  const double step = config.lamp_spacing_m;
  for (double x = config.x_min_m + step / 2; x < config.x_max_m; x += step) {
    for (double y = config.y_min_m + step / 2; y < config.y_max_m; y += step) {
      lamps_.emplace_back(x, y, config.ceiling_m - 0.1);
    }
  }
  const double yaw = Radians(config.window_yaw_deg), up = Radians(config.window_elevation_deg);
  window_ = {std::cos(up) * std::cos(yaw), std::cos(up) * std::sin(yaw), std::sin(up)};
}

double Lighting::Enter(const Box& box, const Vector3d& origin, const Vector3d& direction, int& axis) const {
  const Vector3d d = origin - box.centre;
  // A cheap miss first: most boxes are not near the ray.
  const double along = d.dot(direction), radius2 = box.half.squaredNorm();
  if (d.squaredNorm() - along * along > radius2) return -1;
  const auto turn = [&box](const Vector3d& v) {
    return Vector3d(box.c * v.x() + box.s * v.y(), -box.s * v.x() + box.c * v.y(), v.z());
  };
  return Entry(turn(d), turn(direction), box.half, axis);
}

double Lighting::Hit(const Boxes& boxes, const Vector3d& origin, const Vector3d& direction,
                     double max_m) const {
  double nearest = max_m;
  int axis = 0;
  for (const Box* box : boxes) {
    const double t = Enter(*box, origin, direction, axis);
    if (t > kSkin_m && t < nearest) nearest = t;
  }
  return nearest;
}

Lighting::Boxes Lighting::Within(const Vector3d& point, double reach_m) const {
  Boxes near;
  index_.VisitNear(point.head<2>(), reach_m, [&](std::size_t i) {
    const Box& box = boxes_[i];
    if ((box.centre - point).norm() - box.half.norm() <= reach_m) near.push_back(&box);
  });
  return near;
}

std::optional<FloorHit> Lighting::Floor(const Vector3d& origin, const Vector3d& direction) const {
  if (!config_.holes.empty()) return CastToFloor(config_.holes, origin, direction);
  if (direction.z() >= -1e-9) return std::nullopt;
  return FloorHit{-origin.z() / direction.z(), Vector3d::UnitZ(), -1};
}

double Lighting::Distance(const Vector3d& origin, const Vector3d& direction, double max_m) const {
  return Distance(Within(origin, max_m), origin, direction, max_m);
}

double Lighting::Distance(const Boxes& boxes, const Vector3d& origin, const Vector3d& direction,
                          double max_m) const {
  double nearest = Hit(boxes, origin, direction, max_m);
  if (const auto floor = Floor(origin, direction)) nearest = std::min(nearest, floor->distance_m);
  if (direction.z() > 1e-9) nearest = std::min(nearest, (config_.ceiling_m - origin.z()) / direction.z());
  return std::max(nearest, 0.0);
}

RayHit Lighting::Trace(const Vector3d& origin, const Vector3d& direction, double max_m) const {
  RayHit hit{max_m, -direction, kNothing};
  const auto take = [&](double t, const Vector3d& normal, int solid, bool mirror = false) {
    if (t > kSkin_m && t < hit.distance_m) hit = {t, normal, solid, mirror};
  };
  if (const auto floor = Floor(origin, direction))
    take(floor->distance_m, floor->normal, floor->hole < 0 ? kFloor : kFirstHole - floor->hole);
  if (direction.z() > 1e-9)
    take((config_.ceiling_m - origin.z()) / direction.z(), -Vector3d::UnitZ(), kCeiling);
  for (const Box& box : boxes_) {
    int axis = 0;
    const double t = Enter(box, origin, direction, axis);
    const Vector3d axes[] = {{box.c, box.s, 0}, {-box.s, box.c, 0}, {0, 0, 1}};
    take(t, axes[axis].dot(direction) < 0 ? axes[axis] : Vector3d(-axes[axis]), box.solid, box.mirror);
  }
  return hit;
}

double Lighting::Ambient(const Vector3d& point, const Vector3d& normal) const {
  static const std::array<Vector3d, kAmbientRays> kDirections = CosineDirections();
  const Vector3d u =
      (std::abs(normal.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX()).cross(normal).normalized();
  const Vector3d v = normal.cross(u);
  const Boxes near = Within(point, kAmbientReach_m);
  double open = 0;
  for (const Vector3d& d : kDirections) {
    const Vector3d direction = d.x() * u + d.y() * v + d.z() * normal;
    open += std::min(Distance(near, point, direction, kAmbientReach_m) / kAmbientReach_m, 1.0);
  }
  return 0.25 + 0.75 * open / kAmbientRays;  // what hides the room still reflects some of its light
}

double Lighting::Lamps(const Vector3d& point, const Vector3d& normal) const {
  const Boxes near = Within(point, kLampReach_m);
  double sum = 0;
  for (const Vector3d& lamp : lamps_) {
    const Vector3d to_lamp = lamp - point;
    const double distance = to_lamp.norm(), facing = normal.dot(to_lamp);
    if (distance > kLampReach_m || distance < 1e-6 || facing <= 0) continue;
    if (Hit(near, point, to_lamp / distance, distance) < distance) continue;
    // A tube under a white ceiling is no point: its size keeps the light even close by, and it shines
    // sideways.
    const double soft = std::hypot(distance, kLampSize_m);
    sum += (0.35 + 0.65 * to_lamp.z() / soft) * facing / (soft * soft * soft) * (1 - distance / kLampReach_m);
  }
  return kLampPower * sum;
}

double Lighting::At(const Vector3d& point, const Vector3d& normal) const {
  const double ambient = Ambient(point, normal);
  const double window = ambient * 1.4 * std::pow(0.5 + 0.5 * normal.dot(window_), 2.0);
  const double lamps = 1 - config_.ambient - config_.window;
  return config_.brightness *
         (config_.ambient * ambient + config_.window * window + lamps * std::min(Lamps(point, normal), 2.0));
}

}  // namespace priamos::world
