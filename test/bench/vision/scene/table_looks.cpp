#include "test/bench/vision/scene/table_looks.hpp"

#include <algorithm>
#include <cmath>

#include "common/config.hpp"
#include "common/rectangle.hpp"
#include "common/robot/body_size.hpp"
#include "head/head_config.hpp"
#include "test/bench/vision/true_axes.hpp"
#include "world/core/generate/generate.hpp"
#include "world/core/scene/build_solids.hpp"
#include "world/core/scene/outline.hpp"

namespace priamos::bench {
namespace {

constexpr const char* kMaterials[] = {"cardboard", "furniture", "cupboard", "wood"};
constexpr double kBetween_m = 0.42;  // 0.3 m/s, 1.4 s
constexpr int kLooks = 3;
constexpr double kFront_m = kDrawnBody.length_m / 2;

world::BoxPlan DrawTable(const Pose2& map_from_base, double gap_m, bool square, Rng& rng) {
  world::BoxPlan top;
  top.name = "table";
  top.length_m = rng.Uniform(0.5, 1.6);
  top.width_m = rng.Uniform(0.4, 0.8);
  top.height_m = rng.Uniform(0.02, 0.05);
  top.bottom_m = rng.Uniform(0.5, 0.95);
  top.material = kMaterials[rng.Below(4)];
  const double yaw =
      Radians(90 * static_cast<double>(rng.Below(2)) + (square ? rng.Uniform(-4, 4) : rng.Uniform(10, 80)));
  const Rectangle at_origin{{0, 0, yaw}, {top.length_m / 2, top.width_m / 2}};
  double nearest = 0;
  for (const Eigen::Vector2d& corner : at_origin.Corners()) nearest = std::min(nearest, corner.x());
  const Pose2 at = map_from_base * Pose2{kFront_m + gap_m - nearest, rng.Uniform(-0.4, 0.4), yaw};
  top.x_m = at.x;
  top.y_m = at.y;
  top.yaw_deg = Degrees(at.yaw);
  return top;
}

/// Four legs, so far inside of its corners.
void AddLegs(const world::BoxPlan& top, double inset_m, world::WorldPlan& plan) {
  const Pose2 map_from_top{top.x_m, top.y_m, Radians(top.yaw_deg)};
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      const Pose2 leg =
          map_from_top * Pose2{a * (top.length_m / 2 - inset_m), b * (top.width_m / 2 - inset_m), 0};
      plan.boxes.push_back({"leg", leg.x, leg.y, top.yaw_deg, 0.04, 0.04, top.bottom_m, 0, "metal"});
    }
  }
}

/// Whether places along a front, 2 cm behind it, are all within `near_m` of one of the outlines.
template <class Distance>
bool AllNear(const head::SceneObject& object, const Pose2& map_from_base, double near_m, Distance distance) {
  const Pose2 map_from_front = map_from_base * object.base_from_front;
  for (int i = -4; i <= 4; ++i)
    if (distance(map_from_front * Eigen::Vector2d(0.02, 0.11 * i * object.width_m)) > near_m) return false;
  return true;
}

}  // namespace

bool TableApproach::IsReal(const head::SceneObject& object, const Pose2& map_from_base, double near_m) const {
  return AllNear(object, map_from_base, near_m, [&](const Eigen::Vector2d& at) {
    double least = 1e9;
    for (const world::Solid& solid : solids) {
      if (solid.z_min_m > object.top_m + near_m || solid.z_max_m < object.bottom_m - near_m) continue;
      least = std::min(least, Distance(world::OutlineOf(solid), at));
    }
    return least;
  });
}

bool TableApproach::IsOfTable(const head::SceneObject& object, const Pose2& map_from_base,
                              double near_m) const {
  const Rectangle outline{{table.x_m, table.y_m, Radians(table.yaw_deg)},
                          {table.length_m / 2, table.width_m / 2}};
  return std::abs(object.top_m - table.bottom_m - table.height_m) < near_m &&
         AllNear(object, map_from_base, near_m,
                 [&](const Eigen::Vector2d& at) { return Distance(outline, at); });
}

TableApproach TablePhotographer::Take(std::uint64_t seed, const CalibratedHead& head) {
  Rng rng = Rng::Stream(seed, "table approach");
  world::GeneratedWorld made = world::Generate(seed % 3 == 0 ? "floor" : "room", seed);
  TableApproach approach;
  approach.has_table = seed % 4 != 0;
  approach.is_square = seed % 2 != 0;
  const Pose2 door = made.truth.FindDoor(made.door_id)->map_from_door();
  const Pose2 start =
      door * Pose2{-rng.Uniform(3.2, 3.5), rng.Uniform(-0.3, 0.3), Radians(rng.Uniform(-6, 6))};
  const double gap_m = rng.Uniform(1.9, 2.1);
  if (approach.has_table) {
    approach.table = DrawTable(start, gap_m, approach.is_square, rng);
    made.world.boxes.push_back(approach.table);
    const auto legs = rng.Below(3);
    if (legs > 0) AddLegs(approach.table, legs == 1 ? 0.03 : rng.Uniform(0.1, 0.19), made.world);
  }
  world::RendererConfig config;
  config.scene = world::DrawLight(made.world, seed);
  config.head = head.build;
  approach.solids = world::BuildSolids(made.truth, made.world, seed);
  static const auto kConfig = LoadConfig<head::HeadConfig>(InSim("head.toml"));
  head::HeadSetting setting = kConfig.LookSetting();
  setting.tilt_rad = Radians(kConfig.scene.tilt_deg);
  const world::HeadAxes axes = RestAfter(setting, rng);
  world::Renderer renderer(config, approach.solids, seed);
  const world::Exposure exposure{0.008, 1, 0, 0};
  const Twist2 twist{0.3, 0, rng.Uniform(-0.05, 0.05)};
  for (int i = 0; i < kLooks; ++i) {
    TableLook& look = approach.looks.emplace_back();
    look.map_from_base = start * Pose2{kBetween_m * i, 0, 0};
    look.gap_m = gap_m - kBetween_m * i;
    const world::Viewpoint opening{Integrate(look.map_from_base, twist, -exposure.exposure_s / 2), axes},
        closing{Integrate(look.map_from_base, twist, exposure.exposure_s / 2), axes};
    for (int c = 0; c < 3; ++c) {
      look.images[c] = renderer.Expose(static_cast<world::Camera>(c), opening, closing, exposure, rng);
      if (const auto camera = head.model.CameraAt(setting, c)) look.calibrated[c] = *camera;
    }
  }
  return approach;
}

}  // namespace priamos::bench
