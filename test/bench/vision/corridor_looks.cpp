#include "test/bench/vision/corridor_looks.hpp"

#include <algorithm>
#include <cmath>

#include "common/config.hpp"
#include "head/head_config.hpp"
#include "test/bench/vision/scene/eyes.hpp"
#include "test/bench/vision/true_axes.hpp"
#include "world/core/render/lighting.hpp"
#include "world/core/scene/build_solids.hpp"

namespace priamos::bench {
namespace {

constexpr double kClear_m = 0.55;  // of the robot's middle from the walls
constexpr int kAttempts = 12;      // to stand where a door is to be found
constexpr int kZoomStep = 100;     // 840 px: nearly the widest that was calibrated

/// The face of a door that is turned to the robot.
struct Face {
  Pose2 base_from_door;
  double x, half, outer, height, top;
  Eigen::Vector3d At(double y, double z) const {
    const Eigen::Vector2d p = base_from_door * Eigen::Vector2d(x, y);
    return {p.x(), p.y(), z};
  }
};

Face FaceOf(const DoorPlan& door, const Pose2& base_from_map, bool front) {
  const double half = door.opening_width_m / 2, rebate = front ? 0 : door.rebate_width_m;
  return {base_from_map * door.map_from_door(),
          front ? door.FrontX() : door.BackX(),
          half + rebate,
          half + door.frame_width_m,
          door.opening_height_m + rebate,
          door.opening_height_m + door.frame_width_m};
}

bool JambIsSeen(const Face& face, double side, const Eyes& eyes, const ToBeFound& rule) {
  constexpr double kStep_m = 0.05;
  int in_picture = 0, visible = 0;
  for (double z = kStep_m; z < face.height; z += kStep_m) {
    const Eigen::Vector3d at = face.At(side * face.half, z);
    if (!eyes.InPicture(at, 0)) continue;
    ++in_picture;
    visible += eyes.Visible(at);
  }
  return visible * kStep_m >= rule.jamb_m && visible >= rule.jamb_share * in_picture;
}

bool LintelIsSeen(const Face& face, const Eyes& eyes, const ToBeFound& rule) {
  constexpr int kSteps = 20;
  int visible = 0;
  for (int i = 0; i < kSteps; ++i)
    visible += eyes.Visible(face.At(face.half * (2.0 * (i + 0.5) / kSteps - 1), face.height));
  return visible >= rule.lintel_share * kSteps;
}

std::string WhyNot(const TrueDoor& door, const Face& face, const Eyes& eyes, const ToBeFound& rule) {
  for (const double side : {1.0, -1.0})
    if (!eyes.InPicture(face.At(side * face.outer, face.top), rule.border_px)) return kOutOfThePicture;
  if (door.range_m < rule.min_range_m || door.range_m > rule.max_range_m) return "range";
  if (door.slant_deg > rule.max_slant_deg) return "slant";
  for (const double side : {1.0, -1.0})
    if (!JambIsSeen(face, side, eyes, rule)) return "jamb hidden";
  return LintelIsSeen(face, eyes, rule) ? "" : "lintel hidden";
}

TrueDoor AsSeen(const DoorPlan& plan, const world::DoorWork& work, const Eyes& eyes, const ToBeFound& rule) {
  const Pose2 base_from_map = eyes.map_from_base.Inverse();
  const Pose2 door_from_base = plan.map_from_door().Inverse() * eyes.map_from_base;
  const bool front = door_from_base.x < 0;
  const Face face = FaceOf(plan, base_from_map, front);
  TrueDoor door;
  door.name = plan.name;
  door.open_deg = work.open_deg;
  door.opens_to_us = !front;
  door.height_m = face.height;
  door.frame_m = face.outer - face.half;
  const double left = front ? 1 : -1;
  door.left = face.At(left * face.half, 0).head<2>();
  door.right = face.At(-left * face.half, 0).head<2>();
  const Eigen::Vector2d eye =
      head::OpticalCentre(eyes.cameras[0]).head<2>() / 2 + head::OpticalCentre(eyes.cameras[1]).head<2>() / 2;
  const Eigen::Vector2d sight = door.middle() - eye, across = (door.left - door.right).normalized();
  door.range_m = sight.norm();
  door.slant_deg = Degrees(std::asin(std::min(1.0, std::abs(across.dot(sight.normalized())))));
  door.why_not = WhyNot(door, face, eyes, rule);
  door.is_to_be_found = door.why_not.empty();
  return door;
}

std::vector<TrueDoor> DoorsAhead(const CorridorPlan& plan, const Eyes& eyes, const ToBeFound& rule,
                                 Hold hold) {
  std::vector<TrueDoor> doors;
  for (std::size_t i = 0; i < plan.map.doors.size(); ++i) {
    const TrueDoor door = AsSeen(plan.map.doors[i], plan.world.doors[i], eyes, rule);
    const Eigen::Vector3d middle(door.middle().x(), door.middle().y(), 1);
    if (hold == Hold::kInAHand ? eyes.cameras[0].Depth(middle) > 0 : middle.x() > 0) doors.push_back(door);
  }
  return doors;
}

struct Stand {
  Pose2 map_from_base;
  head::HeadSetting setting;
  world::HeadAxes axes;
  std::array<head::CameraModel, 2> exact;
};

/// Head and mast as a hand would hold them.
struct Held {
  double tilt_rad = 0, roll_rad = 0;
};

Held DrawHeld(Rng& rng) {
  return {Radians(rng.Uniform(-8, 8)), Radians(rng.Uniform(-2, 2))};
}

world::HeadBuild BuildOf(const CalibratedHead& head, Hold hold, Rng& rng) {
  world::HeadBuild build = head.build;
  if (hold == Hold::kInAHand) build.z_m += rng.Uniform(-0.2, 0.3);
  return build;
}

Stand DrawStand(const CorridorPlan& plan, const world::HeadBuild& build, const Held* held, Rng& rng) {
  const double reach = plan.width_m / 2 - kClear_m;
  Stand stand;
  stand.map_from_base = {rng.Uniform(0.5, plan.length_m - 3), rng.Uniform(-reach, reach),
                         Radians(rng.Uniform(-10, 10))};
  static const auto kConfig = LoadConfig<head::HeadConfig>(PRIAMOS_SOURCE_DIR "/config/sim/head.toml");
  stand.setting = kConfig.LookSetting();
  stand.setting.zoom_step = {kZoomStep, kZoomStep};
  const double pan_deg =
      rng.Chance(0.4) ? rng.Uniform(-8, 8) : (rng.Chance(0.5) ? 1 : -1) * rng.Uniform(8, 50);
  // The head looks along the corridor or to its sides, whichever way the base is turned.
  stand.setting.pan_rad = std::round((Radians(pan_deg) - stand.map_from_base.yaw) / 0.0001) * 0.0001;
  stand.setting.tilt_rad = std::round(Radians(rng.Uniform(-12, 0)) / 0.0001) * 0.0001;
  if (held) stand.setting.tilt_rad = held->tilt_rad;
  stand.axes = RestAfter(stand.setting, rng);
  if (held) stand.axes.lean.roll_rad = held->roll_rad;
  for (int c = 0; c < 2; ++c) stand.exact[c] = ExactCamera(build, c, stand.axes);
  return stand;
}

/// The robot drives on during the exposure.
void Photograph(world::Renderer& renderer, const Stand& stand, Rng& rng, CorridorLook& look) {
  const world::Exposure exposure{0.008, 1, 0, 0};
  const Twist2 twist{rng.Uniform(0, 0.3), 0, rng.Uniform(-0.05, 0.05)};
  const world::Viewpoint opening{Integrate(stand.map_from_base, twist, -exposure.exposure_s / 2), stand.axes},
      closing{Integrate(stand.map_from_base, twist, exposure.exposure_s / 2), stand.axes};
  for (int c = 0; c < 2; ++c) {
    const GreyImage image = renderer.Expose(static_cast<world::Camera>(c), opening, closing, exposure, rng);
    look.images[c] =
        cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())).clone();
  }
}

}  // namespace

CorridorPhotographer::CorridorPhotographer() : graphics_(world::Renderer::HoldGraphics()) {}

std::vector<CorridorLook> CorridorPhotographer::Take(std::uint64_t seed, int looks,
                                                     const CalibratedHead& head, const ToBeFound& rule,
                                                     Hold hold) {
  Rng rng = Rng::Stream(seed, "look"), hand = Rng::Stream(seed, "hand");
  const world::HeadBuild build = BuildOf(head, hold, hand);
  const CorridorPlan plan = DrawCorridor(seed);
  const std::vector<world::Solid> solids = world::BuildSolids(plan.map, plan.world, seed);
  world::RendererConfig config;
  config.scene = plan.light;
  config.head = build;
  world::Renderer renderer(config, solids, seed);
  const world::Lighting scene(config.scene, solids);
  std::vector<CorridorLook> all(looks);
  for (int i = 0; i < looks; ++i) {
    CorridorLook& look = all[i];
    Stand stand;
    const Held held = DrawHeld(hand);
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      stand = DrawStand(plan, build, hold == Hold::kInAHand ? &held : nullptr, rng);
      const std::array judging{stand.exact[0], stand.exact[hold == Hold::kInAHand ? 0 : 1]};
      look.doors = DoorsAhead(plan, {judging, scene, stand.map_from_base, rule.border_px}, rule, hold);
      const bool any = std::any_of(look.doors.begin(), look.doors.end(),
                                   [](const TrueDoor& door) { return door.is_to_be_found; });
      if (any || i % 2 == 1) break;
    }
    Photograph(renderer, stand, rng, look);
    look.exact = stand.exact;
    for (int c = 0; c < 2; ++c) look.calibrated[c] = *head.model.CameraAt(stand.setting, c);
  }
  return all;
}

}  // namespace priamos::bench
