#include "planner/core/path/door_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/core/map/door_sides.hpp"

namespace priamos::planner {
namespace {

/// Steeper approaches to the axis than this are driven only when there is no longer run-in.
constexpr double kSteepestRunIn = 0.7;
/// Walls so near on both sides of the base make a room a cabin [m].
constexpr double kCabinSide_m = 1.0;
/// Steps in which what is free behind a door is looked for [m].
constexpr double kGoalStep_m = 0.01;
/// A place on the axis this near to the start is where the start is.
constexpr double kHere_m = 0.2;

}  // namespace

void DoorPlannerConfig::Describe(Archive& a) {
  a.Number("door_margin_m", door_margin_m, {"m", 0, 0.2, "planned clearance to each jamb"});
  a.Number("wall_margin_m", wall_margin_m, {"m", 0, 1, "planned clearance everywhere else"});
  a.Number("align_m", align_m, {"m", 0.5, 5, "preferred place to be on the door's axis, straight"});
  a.Number("align_least_m", align_least_m, {"m", 0.5, 5, "nearest such place"});
  a.Number("goal_m", goal_m, {"m", 0.5, 20, "goal behind the door"});
  a.Number("approach_m", approach_m, {"m", 0.5, 10, "place on the axis that the approach leads to"});
  a.Number("hold_m", hold_m,
           {"m", 0.1, 5, "free distance between footprint and wall where the approach ends"});
  if (align_least_m > align_m) a.Refuse("align_least_m", "at most align_m");
}

DoorPlanner::DoorPlanner(const DoorPlannerConfig& config, const Footprint& footprint, const GroundPlan& plan)
    : config_(config), space_(footprint, ObstacleMap(plan)) {}

double DoorPlanner::HoldX(const DoorPlan& door) const {
  return door.FrontX() - config_.hold_m - space_.footprint().length_m / 2;
}

double DoorPlanner::PastX(const DoorPlan& door) const {
  return door.BackX() + space_.footprint().length_m / 2;
}

double DoorPlanner::GoalX(const DoorPlan& door) const {
  const double past_x = PastX(door);
  double free_x = past_x;
  const auto is_free = [&](double x) {
    return space_.DistanceAt(door.map_from_door() * Pose2{x, 0, 0}) >= config_.door_margin_m;
  };
  while (free_x < config_.goal_m && is_free(free_x)) free_x += kGoalStep_m;
  return free_x >= config_.goal_m ? config_.goal_m : (past_x + free_x) / 2;
}

std::optional<Pose2> DoorPlanner::CabinPlace(const DoorPlan& door) const {
  const DoorPlan entrance = FromBehind(door);
  const Pose2 place = entrance.map_from_door() * Pose2{GoalX(entrance), 0, 0};
  const auto is_taken = [&](const Pose2& at) { return space_.DistanceAt(at) <= 0; };
  const bool is_cabin = is_taken(door.map_from_door() * Pose2{HoldX(door), 0, 0}) && !is_taken(place) &&
                        is_taken(place * Pose2{0, kCabinSide_m, 0}) &&
                        is_taken(place * Pose2{0, -kCabinSide_m, 0});
  return is_cabin ? std::optional(place) : std::nullopt;
}

Outcome<PlannedPath> DoorPlanner::CheckPath(const Pose2& start, std::vector<Pose2> points,
                                            std::size_t n_tight) const {
  const double start_gap_m = space_.At(start).distance_m;
  PlannedPath path{.points = {}, .min_gap_m = start_gap_m};
  Pose2 from = start;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool tight = i + n_tight >= points.size();
    // Who stands nearer to a wall than the margin may leave, but not come nearer still.
    const double margin_m =
        tight ? config_.door_margin_m : std::min(config_.wall_margin_m, start_gap_m * 0.9);
    const auto gap = space_.Along(from, points[i]);
    if (gap.distance_m < margin_m)
      return Refusal{fmt::format("the path to the door comes within {:.2f} m of {}, it needs {:.2f} m",
                                 gap.distance_m, gap.obstacle, margin_m)};
    path.min_gap_m = std::min(path.min_gap_m, gap.distance_m);
    path.leeway.push_back(tight ? Leeway{} : space_.LeewayOf(from, points[i], config_.wall_margin_m));
    from = points[i];
  }
  path.points = std::move(points);
  return path;
}

std::vector<std::vector<Pose2>> DoorPlanner::PassageCandidates(const DoorPlan& door,
                                                               const Pose2& start) const {
  std::vector<std::vector<Pose2>> candidates;
  const double goal_x = GoalX(door);
  const auto add = [&](std::vector<Pose2> path_in_door) {
    path_in_door.push_back({goal_x, 0, 0});
    for (Pose2& point : path_in_door) point = door.map_from_door() * point;
    candidates.push_back(std::move(path_in_door));
  };
  constexpr int kPlaces = 4;
  for (int i = 0; i < kPlaces; ++i) {
    const double x = -config_.align_m + i * (config_.align_m - config_.align_least_m) / (kPlaces - 1);
    const double run_in_m = x - start.x;
    if (run_in_m >= kHere_m && std::abs(start.y) <= kSteepestRunIn * run_in_m) add({{x, 0, 0}});
  }
  if (-config_.align_least_m - start.x >= kHere_m) add({{-config_.align_least_m, 0, 0}});
  add({{std::min(start.x, -config_.align_least_m), 0, 0}});
  for (const double x : {-config_.align_m, -config_.align_m - 0.5}) {
    add({{x, 0, 0}});
    add({{x, start.y, start.yaw}, {x, 0, 0}});
    add({{x, start.y, 0}, {x, 0, 0}});
  }
  return candidates;
}

std::optional<Refusal> DoorPlanner::CheckDoor(const DoorPlan& door) const {
  if (door.opening_width_m < NeededWidth())
    return Refusal{fmt::format("door '{}' is too narrow: needs {:.2f} m, opening is {:.2f} m", door.name,
                               NeededWidth(), door.opening_width_m)};
  if (door.opening_height_m < space_.footprint().height_m)
    return Refusal{fmt::format("door '{}' is too low: needs {:.2f} m, opening is {:.2f} m", door.name,
                               space_.footprint().height_m, door.opening_height_m)};
  return std::nullopt;
}

std::optional<Refusal> DoorPlanner::CheckStart(const DoorPlan& door, const Pose2& map_from_start) const {
  const double beyond_m = (door.map_from_door().Inverse() * map_from_start).x - door.FrontX();
  if (beyond_m >= 0)
    return Refusal{fmt::format("the robot is {:.2f} m behind door '{}', not before it", beyond_m, door.name)};
  const auto gap = space_.At(map_from_start);
  if (gap.distance_m <= 0) return StandsIn(map_from_start, gap.obstacle);
  return std::nullopt;
}

Outcome<PlannedPath> DoorPlanner::PlanPassage(const DoorPlan& door, const Pose2& map_from_start) const {
  if (const auto refusal = CheckDoor(door)) return *refusal;
  if (const auto refusal = CheckStart(door, map_from_start)) return *refusal;
  std::optional<Refusal> first_refusal;
  for (auto& candidate : PassageCandidates(door, door.map_from_door().Inverse() * map_from_start)) {
    Outcome<PlannedPath> path = CheckPath(map_from_start, std::move(candidate), 1);
    if (path) return path;
    if (!first_refusal) first_refusal = Refusal{path.reason()};
  }
  return *first_refusal;
}

Outcome<PlannedPath> DoorPlanner::PlanRetreat(const DoorPlan& door, const Pose2& map_from_start) const {
  const Pose2 door_from_start = door.map_from_door().Inverse() * map_from_start;
  if (door_from_start.x >= PastX(door))
    return Refusal{fmt::format("the robot is behind door '{}', not in it", door.name)};
  if (const auto cabin = CabinPlace(door))
    return PlannedPath{.points = {{cabin->x, cabin->y, map_from_start.yaw}}};
  const double hold_x = std::min(HoldX(door), door_from_start.x);
  // Wherever it may touch, it has come from the hold point: there is no better way.
  return PlannedPath{.points = {door.map_from_door() * Pose2{hold_x, 0, 0}}};
}

Outcome<PlannedPath> DoorPlanner::PlanLeave(const DoorPlan& door, const Pose2& map_from_start) const {
  if (const auto refusal = CheckDoor(door)) return *refusal;
  if (const auto refusal = CheckStart(door, map_from_start)) return *refusal;
  const Pose2 door_from_start = door.map_from_door().Inverse() * map_from_start;
  const double yaw = std::abs(door_from_start.yaw) < kPi / 2 ? 0 : kPi;
  std::vector<Pose2> points{{door_from_start.x, 0, yaw}, {GoalX(door), 0, yaw}};
  for (Pose2& point : points) point = door.map_from_door() * point;
  return CheckPath(map_from_start, std::move(points), 2);
}

Outcome<PlannedPath> DoorPlanner::PlanStandBack(const DoorPlan& door, const Pose2& map_from_start,
                                                double distance_m) const {
  return CheckPath(map_from_start, {door.map_from_door() * Pose2{-distance_m, 0, 0}}, 0);
}

Outcome<PlannedPath> DoorPlanner::PlanApproach(const DoorPlan& door, const Pose2& map_from_start) const {
  if (const auto refusal = CheckStart(door, map_from_start)) return *refusal;
  const Pose2 door_from_start = door.map_from_door().Inverse() * map_from_start;
  const double hold_x = HoldX(door), approach_x = std::min(-config_.approach_m, hold_x);
  std::vector<Pose2> points;
  if (approach_x - door_from_start.x >= kHere_m)
    points.push_back(door.map_from_door() * Pose2{approach_x, 0, 0});
  points.push_back(door.map_from_door() * Pose2{hold_x, 0, 0});
  return CheckPath(map_from_start, std::move(points), 0);
}

}  // namespace priamos::planner
