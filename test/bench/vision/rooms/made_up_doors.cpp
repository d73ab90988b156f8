#include "test/bench/vision/rooms/made_up_doors.hpp"

#include <algorithm>

#include "planner/core/map/door_landmark.hpp"
#include "world/core/generate/generate.hpp"

namespace priamos::bench {
namespace {

/// Closes the wall where the door was: each piece that ended at the opening goes on to its middle.
void RemoveDoor(const DoorPlan& door, LookStage& stage) {
  const Eigen::Vector2d middle(door.x_m, door.y_m);
  const double reach = door.opening_width_m / 2 + 0.01;
  for (WallPlan& wall : stage.map.walls)
    for (auto* end : {&wall.from_m, &wall.to_m})
      if ((Eigen::Vector2d((*end)[0], (*end)[1]) - middle).norm() < reach) *end = {middle.x(), middle.y()};
  std::erase_if(stage.map.doors, [&](const DoorPlan& d) { return d.id == door.id; });
  std::erase_if(stage.plan.doors, [&](const world::DoorWork& d) { return d.id == door.id; });
}

/// Broader or narrower than `surveyed` by 6 to 15 cm, and up to 20 cm beside its place.
void OtherDoor(const DoorPlan& truth, const DoorPlan& surveyed, LookStage& stage, Rng& rng) {
  const double wider =
      surveyed.opening_width_m - truth.opening_width_m + (rng.Chance(0.5) ? 1 : -1) * rng.Uniform(0.06, 0.15);
  for (world::DoorWork& work : stage.plan.doors)
    if (work.id == truth.id) work.built_dwidth_m = wider, work.built_dy_m = rng.Uniform(-0.2, 0.2);
}

LookStage MakeStage(const std::string& kind, std::uint64_t seed, RoomTrouble trouble) {
  Rng rng = Rng::Stream(seed, "room look");
  const world::GeneratedWorld made = world::Generate(kind, seed);
  LookStage stage;
  stage.plan = made.world;
  stage.map = made.truth;
  stage.light = world::DrawLight(stage.plan, seed);
  stage.distance_m = rng.Uniform(2.0, 3.4);
  const DoorPlan door = *stage.map.FindDoor(made.door_id);
  const DoorPlan surveyed = *made.surveyed.FindDoor(made.door_id);
  stage.landmark = planner::MakeDoorLandmark(surveyed);
  stage.landmark.map_from_landmark = door.map_from_door();
  if (trouble == RoomTrouble::kDoorAbsent) RemoveDoor(door, stage);
  if (trouble == RoomTrouble::kAnotherDoor) OtherDoor(door, surveyed, stage, rng);
  if (trouble == RoomTrouble::kOtherLight) stage.ChangeLight();
  return stage;
}

}  // namespace

const char* Describe(RoomTrouble trouble) {
  constexpr const char* kWords[] = {"nothing", "door absent", "another door", "other light"};
  return kWords[static_cast<int>(trouble)];
}

RoomPhotographer::RoomPhotographer() : graphics_(world::Renderer::HoldGraphics()) {}

RoomLook RoomPhotographer::Take(const std::string& kind, std::uint64_t seed, RoomTrouble trouble,
                                const CalibratedHead& head, int visit) {
  LookStage stage = MakeStage(kind, seed, trouble);
  stage.visit = visit;
  const int side = static_cast<int>((seed + visit) % 3);
  RoomLook room{TakeLook(stage, head, {0, 0}, side, seed), stage.plan.wall_material, stage.light.floor};
  room.look.is_there = trouble == RoomTrouble::kNone || trouble == RoomTrouble::kOtherLight;
  return room;
}

}  // namespace priamos::bench
