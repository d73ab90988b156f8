#include "cli/report/report_found_doors.hpp"

#include <algorithm>
#include <cmath>

#include "cli/report/report_timeline.hpp"
#include "common/learned/door_book.hpp"
#include "common/learned/learned_walls.hpp"
#include "planner/map_keeper.hpp"

namespace priamos::cli {
namespace {

using Eigen::Vector2d;

constexpr double kBeside_m = 2;  ///< a door so far beside the way is on it ...
constexpr double kAskew =
    0.5;  ///< ... if the base passes it along its wall: cosine of the heading to the door's axis
constexpr double kFound_m = 0.5;  ///< from the truth; what is farther is another door, or none
constexpr double kAjar_deg = 30;

/// The base drives past the door, not towards it.
bool IsOnTheWay(const DoorPlan& door, const RunRecord& record) {
  return std::any_of(record.truth.begin(), record.truth.end(), [&](const world_truth_t& truth) {
    const Pose2 there = door.map_from_door().Inverse() * Pose2{truth.x_m, truth.y_m, truth.yaw_rad};
    return std::abs(there.y) < 0.1 && std::abs(there.x) < kBeside_m && std::abs(std::cos(there.yaw)) < kAskew;
  });
}

double LeafAngle_deg(const DoorPlan& door, const TrueWorld& world) {
  for (const world::Solid& solid : world.solids)
    if (solid.name == world::LeafName(door))
      return std::abs(Degrees(WrapAngle(solid.map_from_solid.yaw - door.map_from_door().yaw)));
  return 180;
}

std::string StateOf(double open_deg) {
  if (open_deg == 0) return "closed";
  return open_deg < kAjar_deg ? "ajar" : "open";
}

/// The doors at the end of the run.
LearnedWalls MapOf(const RunRecord& record) {
  LearnedWalls map;
  for (const door_found_t& message : record.doors)
    if (const auto told = planner::FromMessage(message)) EnterDoor(*told, map);
  return map;
}

void Judge(const LearnedDoor& told, const DoorPlan& built, const RunRecord& record, FoundDoor& found) {
  found.told = told.state;
  found.sigma_along_m = told.sigma_along_m;
  found.sigma_across_m = told.sigma_across_m;
  const auto belief_from_truth =
      BeliefFromTruth(record, static_cast<std::int64_t>(std::llround(told.seen_s * 1e6)));
  if (!belief_from_truth) return;
  const Pose2 expected = *belief_from_truth * built.map_from_door();
  // What is seen are the front edges of the frame.
  const Vector2d off = expected.Inverse() * told.map_from_door().translation();
  const double front =
      std::abs(off.x() - built.FrontX()) < std::abs(off.x() - built.BackX()) ? built.FrontX() : built.BackX();
  found.across_m = off.x() - front;
  found.along_m = off.y();
}

}  // namespace

std::optional<FoundDoors> FoundDoorsOf(const RunRecord& record, const RunInfo& info) {
  const bool ordered = std::any_of(record.orders.begin(), record.orders.end(), [](const auto& order) {
    return order.mission == mission_command_t::CORRIDOR;
  });
  if (record.doors.empty() && !ordered) return std::nullopt;
  const LearnedWalls map = MapOf(record);
  FoundDoors doors;
  std::vector<bool> is_true(map.doors.size(), false);
  for (const DoorPlan& built : info.world.doors) {
    const double open_deg = LeafAngle_deg(built, info.world);
    FoundDoor found;
    found.name = built.name;
    found.state = StateOf(open_deg);
    found.open_deg = open_deg;
    for (std::size_t i = 0; i < map.doors.size(); ++i) {
      const Vector2d away = map.doors[i].map_from_door().translation() - Vector2d(built.x_m, built.y_m);
      if (away.norm() > kFound_m) continue;
      is_true[i] = true;
      Judge(map.doors[i], built, record, found);
    }
    if (IsOnTheWay(built, record)) doors.on_the_way.push_back(found);
  }
  doors.false_ones = static_cast<int>(std::count(is_true.begin(), is_true.end(), false));
  return doors;
}

}  // namespace priamos::cli
