#include "test/bench/door_looks.hpp"

#include <cmath>

#include "head/core/aim.hpp"
#include "head/head_config.hpp"
#include "planner/core/door_landmark.hpp"
#include "test/bench/true_axes.hpp"

namespace priamos::bench {
namespace {

constexpr double kDistance_m = 2.4;  // of the head
constexpr int kDoor = 1;

std::string InSim(const std::string& name) {
  return PRIAMOS_SOURCE_DIR "/config/sim/" + name;
}

/// What the seed makes of the world file.
struct Set {
  world::WorldPlan plan;
  GroundPlan map;
  world::SceneConfig light;
};

void RemoveDoor(Set& set) {
  set.map.doors.clear(), set.plan.doors.clear();
  for (WallPlan& wall : set.map.walls)
    if (wall.name == "right of the door")
      wall.to_m = {6.0, 2.4};
    else if (wall.name == "left of the door")
      wall.from_m = {6.0, 2.4};
}

/// A box before one half of the door, or in the doorway.
void HideHalf(Set& set, Rng& rng) {
  world::BoxPlan box;
  box.name = "in the way";
  const double side = rng.Chance(0.5) ? 1 : -1;
  box.x_m = 6.0 - rng.Uniform(0.3, 1.2), box.y_m = 2.4 + side * rng.Uniform(0.25, 0.6);
  box.length_m = rng.Uniform(0.2, 0.5), box.width_m = rng.Uniform(0.4, 0.9),
  box.height_m = rng.Uniform(1.4, 2.1);
  box.yaw_deg = rng.Uniform(-20, 20);
  box.material = rng.Chance(0.5) ? "cupboard" : "cardboard";
  set.plan.boxes.push_back(box);
}

/// Of another width by 6 cm to 15 cm: not the one that is looked for.
void OtherDoor(Set& set, Rng& rng) {
  const double wider = (rng.Chance(0.5) ? 1 : -1) * rng.Uniform(0.06, 0.15);
  set.plan.doors[0].built_dwidth_m = wider;
  set.plan.doors[0].built_dy_m = rng.Uniform(-0.2, 0.2);
  for (WallPlan& wall : set.map.walls)  // up to the frame, wherever it is now
    if (wall.name == "right of the door")
      wall.to_m = {6.0, 2.4};
    else if (wall.name == "left of the door")
      wall.from_m = {6.0, 2.4};
}

Set MakeSet(std::uint64_t seed, Trouble trouble) {
  Rng rng = Rng::Stream(seed, "trouble");
  Set set{LoadConfig<world::WorldPlan>(InSim("worlds/door.toml")), {}, {}};
  set.map = LoadConfig<GroundPlan>(InSim(set.plan.map));
  set.light = world::DrawLight(set.plan, seed);
  if (trouble == Trouble::kDoorAbsent) RemoveDoor(set);
  if (trouble == Trouble::kAnotherDoor) OtherDoor(set, rng);
  if (trouble == Trouble::kHalfHidden) HideHalf(set, rng);
  if (trouble == Trouble::kLeafMoved) set.plan.doors[0].open_deg = rng.Uniform(0, 90);
  if (trouble == Trouble::kLeafMoved) set.plan.doors[0].open_spread_deg = 0;
  if (trouble == Trouble::kLightsOut)
    set.light.brightness *= std::exp(rng.Uniform(std::log(0.01), std::log(0.2)));
  return set;
}

head::LandmarkModel ModelOf(const DoorPlan& door) {
  const planner::Landmark landmark = planner::MakeDoorLandmark(door);
  head::LandmarkModel model{landmark.id, landmark.map_from_landmark, {}};
  for (const planner::LandmarkEdge& e : landmark.edges)
    model.edges.push_back({e.from, e.to, e.visible_from_rad, e.visible_to_rad, static_cast<int>(e.side)});
  return model;
}

/// Every edge shifted and tilted across itself.
head::LandmarkModel Tolerated(head::LandmarkModel model, const DoorTolerances& t, Rng& rng) {
  for (head::LandmarkEdge& e : model.edges) {
    const Eigen::Vector3d along = (e.to - e.from).normalized(), a = along.unitOrthogonal(),
                          b = along.cross(a);
    const Eigen::Vector3d shift = rng.Normal(t.model_sigma_m) * a + rng.Normal(t.model_sigma_m) * b;
    const Eigen::Vector3d tilt = rng.Normal(t.tilt_sigma_m) * a + rng.Normal(t.tilt_sigma_m) * b;
    e.from += shift - tilt, e.to += shift + tilt;
  }
  return model;
}

/// As the shipped configuration of the simulated head has it.
head::HeadSetting LookAt(const head::HeadModel& head, const head::LandmarkModel& model, const Pose2& believed,
                         int side) {
  static const auto kConfig = LoadConfig<head::HeadConfig>(InSim("head.toml"));
  head::HeadSetting setting = kConfig.LookSetting();
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();
  setting.pan_rad = head::AimPan(head, setting, model, {believed, covariance}, side, kConfig.aim);
  setting.pan_rad = std::round(setting.pan_rad / 0.0001) * 0.0001;  // whole steps
  return setting;
}

}  // namespace

const char* Describe(Trouble trouble) {
  constexpr const char* kWords[] = {"nothing",     "door absent", "another door",
                                    "half hidden", "leaf moved",  "lights out"};
  return kWords[static_cast<int>(trouble)];
}

head::LandmarkModel ModelWithLeaf(double open_deg) {
  static const auto kMap = LoadConfig<GroundPlan>(InSim("maps/door.toml"));
  DoorPlan door = *kMap.FindDoor(kDoor);
  door.leaf = "left", door.leaf_open_deg = open_deg;
  return ModelOf(door);
}

DoorPhotographer::DoorPhotographer() : graphics_(world::Renderer::HoldGraphics()) {}

DoorLook DoorPhotographer::Take(std::uint64_t seed, Trouble trouble, const CalibratedHead& head,
                                const DoorTolerances& tolerances, int side) {
  Rng rng = Rng::Stream(seed, "look");
  const Set set = MakeSet(seed, trouble);
  const GroundPlan planned = LoadConfig<GroundPlan>(InSim(set.plan.map));
  DoorLook look;
  look.door_is_there = trouble != Trouble::kDoorAbsent && trouble != Trouble::kAnotherDoor;
  look.exact_model = ModelOf(*planned.FindDoor(kDoor));
  look.leaf_open_deg = set.plan.doors.empty() ? 0 : set.plan.doors[0].open_deg;
  look.model = Tolerated(look.exact_model, tolerances, rng);
  look.base_covariance = head.model.base_covariance;
  // What is believed is nominal; the truth lies around it.
  const Pose2 door_from_believed{-kDistance_m - head.build.x_m, 0, 0};
  const double radius = 0.2 * std::sqrt(rng.Uniform(0, 1)), bearing = rng.Uniform(-kPi, kPi);
  const Pose2 door_from_base{door_from_believed.x + radius * std::cos(bearing), radius * std::sin(bearing),
                             Radians(rng.Uniform(-5, 5))};
  look.believed = door_from_believed.Inverse(), look.truth = door_from_base.Inverse();

  const head::HeadSetting setting = look.setting = LookAt(head.model, look.exact_model, look.believed, side);
  world::RendererConfig config;
  config.scene = set.light, config.head = head.build;
  world::Renderer renderer(config, world::BuildSolids(set.map, set.plan, seed), seed);
  Rng motors = Rng::Stream(seed, "motors " + std::to_string(side));
  const world::HeadAxes axes = RestAfter(setting, motors);
  const Pose2 map_from_base = planned.FindDoor(kDoor)->map_from_door() * door_from_base;
  const world::Exposure exposure{0.008, 1, 0, 0};
  const Twist2 twist{rng.Uniform(0, 0.3), 0, rng.Uniform(-0.05, 0.05)};
  const world::Viewpoint opening{Integrate(map_from_base, twist, -exposure.exposure_s / 2), axes},
      closing{Integrate(map_from_base, twist, exposure.exposure_s / 2), axes};
  Rng noise = Rng::Stream(seed, "noise " + std::to_string(side));
  for (int c = 0; c < 2; ++c) {
    const GreyImage image = renderer.Expose(static_cast<world::Camera>(c), opening, closing, exposure, noise);
    look.images[c] =
        cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())).clone();
    look.calibrated[c] = *head.model.CameraAt(setting, c);
    look.exact[c] = ExactCamera(head.build, c, axes);
  }
  return look;
}

}  // namespace priamos::bench
