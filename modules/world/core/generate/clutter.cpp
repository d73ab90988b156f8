#include "world/core/generate/clutter.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {
namespace {

constexpr int kTries = 20;
constexpr double kApart_m = 0.1;

double DistanceToPiece(const Eigen::Vector2d& at, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double length2 = along.squaredNorm();
  const double part = length2 > 0 ? std::clamp((at - from).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (at - from - part * along).norm();
}

BoxPlan Thing(Rng& rng) {
  BoxPlan box;
  switch (rng.Below(4)) {
    case 0:
      box.name = "carton";
      box.length_m = rng.Uniform(0.2, 0.6);
      box.width_m = rng.Uniform(0.2, 0.6);
      box.height_m = rng.Uniform(0.1, 0.8);
      box.material = "cardboard";
      break;
    case 1:
      box.name = "cupboard";
      box.length_m = rng.Uniform(0.6, 1.6);
      box.width_m = rng.Uniform(0.35, 0.45);
      box.height_m = rng.Uniform(0.8, 2.0);
      box.material = "cupboard";
      break;
    case 2:
      box.name = "bin";
      box.length_m = box.width_m = rng.Uniform(0.2, 0.4);
      box.height_m = rng.Uniform(0.3, 0.7);
      box.material = "metal";
      break;
    default:
      box.name = "post";
      box.length_m = box.width_m = rng.Uniform(0.02, 0.15);
      box.height_m = rng.Uniform(0.8, 2.2);
      box.material = "metal";
  }
  box.yaw_deg = rng.Uniform(-180, 180);
  return box;
}

double RadiusOf(const BoxPlan& box) {
  return std::hypot(box.length_m, box.width_m) / 2;
}

/// A table top at `box`, on four legs.
void AddTable(const BoxPlan& top, std::vector<BoxPlan>& boxes) {
  constexpr double kLeg_m = 0.05;
  boxes.push_back(top);
  const Pose2 map_from_top{top.x_m, top.y_m, Radians(top.yaw_deg)};
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      const Pose2 leg =
          map_from_top * Pose2{a * (top.length_m - kLeg_m) / 2, b * (top.width_m - kLeg_m) / 2, 0};
      BoxPlan box{"table leg", leg.x, leg.y, top.yaw_deg, kLeg_m, kLeg_m, top.bottom_m, 0, "metal"};
      boxes.push_back(box);
    }
}

BoxPlan TableTop(Rng& rng) {
  BoxPlan top;
  top.name = "table top";
  top.length_m = rng.Uniform(1.0, 1.6);
  top.width_m = rng.Uniform(0.6, 0.8);
  top.height_m = 0.03;
  top.bottom_m = rng.Uniform(0.66, 0.74);
  top.yaw_deg = 90 * static_cast<double>(rng.Below(2));
  return top;
}

}  // namespace

double Lane::DistanceTo(const Eigen::Vector2d& at) const {
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    nearest = std::min(nearest, DistanceToPiece(at, points[i], points[i + 1]));
  return nearest - half_m;
}

void AddClutter(const Ground& ground, const Lane& lane, int count, Rng& rng, WorldPlan& world) {
  for (int i = 0; i < count; ++i) {
    const bool table = rng.Chance(0.2);
    BoxPlan box = table ? TableTop(rng) : Thing(rng);
    const double radius = RadiusOf(box);
    for (int k = 0; k < kTries; ++k) {
      const Eigen::Vector2d at{rng.Uniform(ground.low.x(), ground.high.x()),
                               rng.Uniform(ground.low.y(), ground.high.y())};
      const bool inside =
          ((at - ground.low).array() > radius).all() && ((ground.high - at).array() > radius).all();
      const bool free = std::all_of(world.boxes.begin(), world.boxes.end(), [&](const BoxPlan& other) {
        return (at - Eigen::Vector2d(other.x_m, other.y_m)).norm() > radius + RadiusOf(other) + kApart_m;
      });
      if (!inside || !free || lane.DistanceTo(at) < radius) continue;
      box.x_m = at.x();
      box.y_m = at.y();
      table ? AddTable(box, world.boxes) : world.boxes.push_back(box);
      break;
    }
  }
}

}  // namespace priamos::world
