#include "test/bench/vision/door_looks.hpp"

#include <cmath>

#include "common/config.hpp"
#include "planner/core/map/door_landmark.hpp"

namespace priamos::bench {
namespace {

constexpr double kDistance_m = 2.4;  // of the head
constexpr int kDoor = 1;

void RemoveDoor(LookStage& stage) {
  stage.map.doors.clear();
  stage.plan.doors.clear();
  for (WallPlan& wall : stage.map.walls)
    if (wall.name == "right of the door")
      wall.to_m = {6.0, 2.4};
    else if (wall.name == "left of the door")
      wall.from_m = {6.0, 2.4};
}

/// A box before one half of the door, or in the doorway.
void HideHalf(LookStage& stage, Rng& rng) {
  world::BoxPlan box;
  box.name = "in the way";
  const double side = rng.Chance(0.5) ? 1 : -1;
  box.x_m = 6.0 - rng.Uniform(0.3, 1.2);
  box.y_m = 2.4 + side * rng.Uniform(0.25, 0.6);
  box.length_m = rng.Uniform(0.2, 0.5), box.width_m = rng.Uniform(0.4, 0.9),
  box.height_m = rng.Uniform(1.4, 2.1);
  box.yaw_deg = rng.Uniform(-20, 20);
  box.material = rng.Chance(0.5) ? "cupboard" : "cardboard";
  stage.plan.boxes.push_back(box);
}

/// Makes the door wider or narrower by 6 cm to 15 cm, so that it is not the one that is looked for.
void OtherDoor(LookStage& stage, Rng& rng) {
  const double wider = (rng.Chance(0.5) ? 1 : -1) * rng.Uniform(0.06, 0.15);
  stage.plan.doors[0].built_dwidth_m = wider;
  stage.plan.doors[0].built_dy_m = rng.Uniform(-0.2, 0.2);
  for (WallPlan& wall : stage.map.walls)  // up to the frame, wherever it is now
    if (wall.name == "right of the door")
      wall.to_m = {6.0, 2.4};
    else if (wall.name == "left of the door")
      wall.from_m = {6.0, 2.4};
}

/// What the seed makes of the world file.
LookStage MakeStage(std::uint64_t seed, Trouble trouble) {
  Rng rng = Rng::Stream(seed, "trouble");
  LookStage stage{LoadConfig<world::WorldPlan>(InSim("worlds/door.toml")), {}, {}, {}, kDistance_m};
  stage.plan.survey = {};  // the truth is taken from the map
  stage.map = LoadConfig<GroundPlan>(InSim(stage.plan.map));
  stage.landmark = planner::MakeDoorLandmark(*stage.map.FindDoor(kDoor));
  stage.light = world::DrawLight(stage.plan, seed);
  if (trouble == Trouble::kDoorAbsent) RemoveDoor(stage);
  if (trouble == Trouble::kAnotherDoor) OtherDoor(stage, rng);
  if (trouble == Trouble::kHalfHidden) HideHalf(stage, rng);
  if (trouble == Trouble::kLeafMoved) stage.plan.doors[0].open_deg = rng.Uniform(0, 90);
  if (trouble == Trouble::kLeafMoved) stage.plan.doors[0].open_spread_deg = 0;
  if (trouble == Trouble::kOtherLight) stage.ChangeLight();
  if (trouble == Trouble::kLightsOut)
    stage.light.brightness *= std::exp(rng.Uniform(std::log(0.01), std::log(0.2)));
  return stage;
}

}  // namespace

const char* Describe(Trouble trouble) {
  constexpr const char* kWords[] = {"nothing",    "door absent", "another door", "half hidden",
                                    "leaf moved", "lights out",  "other light"};
  return kWords[static_cast<int>(trouble)];
}

head::LandmarkModel ModelWithLeaf(double open_deg) {
  static const auto kMap = LoadConfig<GroundPlan>(InSim("maps/door.toml"));
  DoorPlan door = *kMap.FindDoor(kDoor);
  door.leaf = "left";
  door.leaf_open_deg = open_deg;
  return ToHead(planner::MakeDoorLandmark(door));
}

DoorPhotographer::DoorPhotographer() : graphics_(world::Renderer::HoldGraphics()) {}

LandmarkLook DoorPhotographer::Take(std::uint64_t seed, Trouble trouble, const CalibratedHead& head,
                                    const LookTolerances& tolerances, int side, int visit) {
  LookStage stage = MakeStage(seed, trouble);
  stage.visit = visit;
  LandmarkLook look = TakeLook(stage, head, tolerances, side, seed);
  look.is_there = trouble != Trouble::kDoorAbsent && trouble != Trouble::kAnotherDoor;
  look.leaf_open_deg = stage.plan.doors.empty() ? 0 : stage.plan.doors[0].open_deg;
  return look;
}

LandmarkLook DoorPhotographer::Take(std::uint64_t seed, const LensTrial& trial, const CalibratedHead& head) {
  LookStage stage = MakeStage(seed, Trouble::kNone);
  stage.distance_m = trial.distance_m;
  stage.doubt = trial.doubt;
  stage.choose_lens = trial.choose;
  stage.focus_by_distance = true;
  stage.plan.wall_material = trial.wall;
  return TakeLook(stage, head, {}, static_cast<int>(seed % 3), seed);
}

}  // namespace priamos::bench
