#include "test/bench/vision/scene/scene_looks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/config.hpp"
#include "common/rectangle.hpp"
#include "head/core/camera/projection.hpp"
#include "head/head_config.hpp"
#include "test/bench/vision/true_axes.hpp"
#include "world/core/generate/generate.hpp"
#include "world/core/scene/build_solids.hpp"
#include "world/core/scene/outline.hpp"

namespace priamos::bench {
namespace {

constexpr int kZoomStep = 100;       // nearly the widest that was calibrated
constexpr double kSeenShare = 0.85;  // of an edge, to be found
constexpr double kFarthest_m = 4.0, kLeastSquare = 0.35;
constexpr const char* kMaterials[] = {"cardboard", "furniture", "cupboard"};

Pose2 DrawStand(const world::GeneratedWorld& made, Rng& rng) {
  const Pose2 door = made.truth.FindDoor(made.door_id)->map_from_door();
  return door * Pose2{-rng.Uniform(2.0, 3.5), rng.Uniform(-0.4, 0.4), Radians(rng.Uniform(-15, 15))};
}

/// Boxes before the robot, anywhere in the pictures.
void AddBoxes(const Pose2& map_from_base, world::WorldPlan& plan, Rng& rng) {
  const int n = 1 + static_cast<int>(rng.Uniform(0, 2.999));
  for (int i = 0; i < n; ++i) {
    world::BoxPlan& box = plan.boxes.emplace_back();
    const double range = rng.Uniform(1.2, 4), bearing = Radians(rng.Uniform(-20, 20));
    const Eigen::Vector2d at =
        map_from_base * Eigen::Vector2d(range * std::cos(bearing), range * std::sin(bearing));
    box.name = fmt::format("box {}", i);
    box.x_m = at.x();
    box.y_m = at.y();
    box.yaw_deg = rng.Uniform(-180, 180);
    box.length_m = rng.Uniform(0.2, 1);
    box.width_m = rng.Uniform(0.2, 0.8);
    box.height_m = rng.Uniform(0.3, 1.7);
    box.material = kMaterials[static_cast<int>(rng.Uniform(0, 2.999))];
  }
}

bool EdgeIsSeen(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eyes& eyes) {
  constexpr int kSteps = 20;
  int seen = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector3d at = from + (i + 0.5) / kSteps * (to - from);
    seen += eyes.InPicture(at, eyes.border_px) && eyes.Visible(at);
  }
  return seen >= kSeenShare * kSteps;
}

/// The upper edge and the upper half of both upright ones: what lies below may be hidden.
bool IsToBeFound(const TrueFront& front, const Eyes& eyes) {
  const auto at = [&](const Eigen::Vector2d& p, double z) { return Eigen::Vector3d(p.x(), p.y(), z); };
  const double half = front.top_m / 2, top = front.top_m;
  return EdgeIsSeen(at(front.left, half), at(front.left, top), eyes) &&
         EdgeIsSeen(at(front.right, half), at(front.right, top), eyes) &&
         EdgeIsSeen(at(front.left, top), at(front.right, top), eyes);
}

TrueFront FrontOf(const world::BoxPlan& box, const Eyes& eyes) {
  const Rectangle outline = world::OutlineOf(
      {box.name, {box.x_m, box.y_m, Radians(box.yaw_deg)}, {box.length_m, box.width_m}, 0, box.height_m, ""});
  const auto corners = outline.Corners();
  const Pose2 base_from_map = eyes.map_from_base.Inverse();
  const Eigen::Vector2d eye = head::OpticalCentre(eyes.cameras[0]).head<2>();
  TrueFront front{box.name, {}, {}, box.height_m};
  double best = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    // Counter-clockwise corners: outside is to the right of the way from one to the next.
    const Eigen::Vector2d a = base_from_map * corners[i], b = base_from_map * corners[(i + 1) % 4];
    const Eigen::Vector2d along = (b - a).normalized(), out(along.y(), -along.x());
    const double square = out.dot((eye - (a + b) / 2).normalized());
    if (square <= best) continue;
    best = square;
    front.left = a;
    front.right = b;
    front.depth_m = (i % 2 == 0 ? outline.half_m.y() : outline.half_m.x()) * 2;
  }
  front.is_to_be_found =
      best > kLeastSquare && (front.middle() - eye).norm() < kFarthest_m && IsToBeFound(front, eyes);
  return front;
}

head::HeadSetting DrawSetting(Rng& rng) {
  static const auto kConfig = LoadConfig<head::HeadConfig>(InSim("head.toml"));
  head::HeadSetting setting = kConfig.LookSetting();
  setting.zoom_step = {kZoomStep, kZoomStep};
  const auto whole = [](double rad) { return std::round(rad / 0.0001) * 0.0001; };
  setting.pan_rad = whole(Radians(rng.Uniform(-5, 5)));
  setting.tilt_rad = whole(Radians(rng.Uniform(0, 20)));
  return setting;
}

}  // namespace

ScenePhotographer::ScenePhotographer() : graphics_(world::Renderer::HoldGraphics()) {}

SceneLook ScenePhotographer::Take(std::uint64_t seed, const CalibratedHead& head) {
  Rng rng = Rng::Stream(seed, "scene look");
  world::GeneratedWorld made = world::Generate(seed % 3 == 0 ? "floor" : "room", seed);
  SceneLook look;
  look.map_from_base = DrawStand(made, rng);
  AddBoxes(look.map_from_base, made.world, rng);
  world::RendererConfig config;
  config.scene = world::DrawLight(made.world, seed);
  config.head = head.build;
  const std::vector<world::Solid> solids = world::BuildSolids(made.truth, made.world, seed);
  look.scene = std::make_shared<world::Lighting>(config.scene, solids);
  const head::HeadSetting setting = DrawSetting(rng);
  const world::HeadAxes axes = RestAfter(setting, rng);
  for (int c = 0; c < 2; ++c) look.exact[c] = ExactCamera(head.build, c, axes);
  for (const world::BoxPlan& box : made.world.boxes) look.fronts.push_back(FrontOf(box, look.eyes()));
  world::Renderer renderer(config, solids, seed);
  const world::Exposure exposure{0.008, 1, 0, 0};
  const Twist2 twist{rng.Uniform(0, 0.3), 0, rng.Uniform(-0.05, 0.05)};
  const world::Viewpoint opening{Integrate(look.map_from_base, twist, -exposure.exposure_s / 2), axes},
      closing{Integrate(look.map_from_base, twist, exposure.exposure_s / 2), axes};
  for (int c = 0; c < 3; ++c) {
    look.images[c] = renderer.Expose(static_cast<world::Camera>(c), opening, closing, exposure, rng);
    if (const auto camera = head.model.CameraAt(setting, c)) look.calibrated[c] = *camera;
  }
  return look;
}

}  // namespace priamos::bench
