#include "world/core/generate/clutter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/geometry.hpp"

namespace priamos::world {
namespace {

constexpr int kTries = 20;
constexpr double kApart_m = 0.1;

/// The first kinds are those that a generated building has beside tables.
constexpr std::uint64_t kOfBuildings = 4;

/// Sizes of a kind of thing; a width of 0: its plan is a square.
struct Kind {
  const char *name, *material;
  std::array<double, 2> length_m, width_m, height_m, bottom_m;
};
constexpr std::array kKinds{Kind{"carton", "cardboard", {0.2, 0.6}, {0.2, 0.6}, {0.1, 0.8}, {0, 0}},
                            Kind{"cupboard", "cupboard", {0.6, 1.6}, {0.35, 0.45}, {0.8, 2.0}, {0, 0}},
                            Kind{"bin", "metal", {0.2, 0.4}, {0, 0}, {0.3, 0.7}, {0, 0}},
                            Kind{"post", "metal", {0.02, 0.15}, {0, 0}, {0.8, 2.2}, {0, 0}},
                            Kind{"board", "wood", {0.4, 1.0}, {0.2, 0.4}, {0.03, 0.06}, {0.5, 1.3}},
                            Kind{"glass", "glass", {0.6, 1.2}, {0.01, 0.02}, {1.6, 2.0}, {0, 0}}};

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

BoxPlan Upright(const Kind& kind, Rng& rng) {
  const auto within = [&rng](const std::array<double, 2>& bounds) {
    return bounds[0] < bounds[1] ? rng.Uniform(bounds[0], bounds[1]) : bounds[0];
  };
  BoxPlan box;
  box.name = kind.name;
  box.material = kind.material;
  box.length_m = within(kind.length_m);
  box.width_m = kind.width_m[1] > 0 ? within(kind.width_m) : box.length_m;
  box.height_m = within(kind.height_m);
  box.bottom_m = within(kind.bottom_m);
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

}  // namespace

double Lane::DistanceTo(const Eigen::Vector2d& at) const {
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    nearest = std::min(nearest, DistanceToSegment(points[i], points[i + 1], at));
  return nearest - half_m;
}

BoxPlan DrawThing(const std::string& kind, Rng& rng) {
  if (kind == "table") return TableTop(rng);
  const auto* known =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) { return kind == k.name; });
  if (known == kKinds.end()) throw std::invalid_argument("no thing \"" + kind + "\"");
  return Upright(*known, rng);
}

void AddThing(const std::string& kind, const BoxPlan& thing, WorldPlan& world) {
  kind == "table" ? AddTable(thing, world.boxes) : world.boxes.push_back(thing);
}

bool PlaceThing(const Ground& ground, const std::function<bool(const Eigen::Vector2d&, double)>& is_free,
                const WorldPlan& world, Rng& rng, BoxPlan& thing) {
  const double radius = RadiusOf(thing);
  for (int i = 0; i < kTries; ++i) {
    const Eigen::Vector2d at{rng.Uniform(ground.low.x(), ground.high.x()),
                             rng.Uniform(ground.low.y(), ground.high.y())};
    const bool inside =
        ((at - ground.low).array() > radius).all() && ((ground.high - at).array() > radius).all();
    const bool apart = std::all_of(world.boxes.begin(), world.boxes.end(), [&](const BoxPlan& other) {
      return (at - Eigen::Vector2d(other.x_m, other.y_m)).norm() > radius + RadiusOf(other) + kApart_m;
    });
    if (!inside || !apart || !is_free(at, radius)) continue;
    thing.x_m = at.x();
    thing.y_m = at.y();
    return true;
  }
  return false;
}

void AddClutter(const Ground& ground, const Lane& lane, int count, Rng& rng, WorldPlan& world) {
  const auto is_free = [&lane](const Eigen::Vector2d& at, double radius) {
    return lane.DistanceTo(at) >= radius;
  };
  for (int i = 0; i < count; ++i) {
    const bool table = rng.Chance(0.2);
    const std::string kind = table ? "table" : kKinds.at(rng.Below(kOfBuildings)).name;
    BoxPlan thing = DrawThing(kind, rng);
    if (PlaceThing(ground, is_free, world, rng, thing)) AddThing(kind, thing, world);
  }
}

}  // namespace priamos::world
