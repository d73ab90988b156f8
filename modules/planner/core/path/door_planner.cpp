#include "planner/core/path/door_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

/// Sweep steps: no corner of a 1 m body moves more than about 1 cm between two checked poses.
constexpr double kStep_m = 0.005;
constexpr double kStep_rad = Radians(0.5);
/// Steeper approaches to the axis than this are driven only when there is no longer run-in.
constexpr double kSteepestRunIn = 0.7;
/// A place on the axis this near to the start is where the start is.
constexpr double kHere_m = 0.2;
/// Leeway is looked for in such steps up to this; checked by coarser sweeps, for it is wide.
constexpr double kLeewayStep_m = 0.1, kMostLeeway_m = 2.0, kCoarse = 10;

Pose2 Between(const Pose2& from, const Pose2& to, double part) {
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
          WrapAngle(from.yaw + part * WrapAngle(to.yaw - from.yaw))};
}

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
    : config_(config), footprint_(footprint), obstacles_(plan) {}

double DoorPlanner::HoldX(const DoorPlan& door) const {
  return door.FrontX() - config_.hold_m - footprint_.length_m / 2;
}

double DoorPlanner::PastX(const DoorPlan& door) const {
  return door.BackX() + footprint_.length_m / 2;
}

DoorPlanner::Sweep DoorPlanner::SweepAlong(const Pose2& from, const Pose2& to, double coarser) const {
  const double length_m = (to.translation() - from.translation()).norm();
  const double turn_rad = std::abs(WrapAngle(to.yaw - from.yaw));
  const int steps =
      std::max(1, static_cast<int>(std::ceil(std::max(length_m / kStep_m, turn_rad / kStep_rad) / coarser)));
  Sweep sweep{std::numeric_limits<double>::infinity(), ""};
  for (int i = 0; i <= steps; ++i) {
    const auto nearest = obstacles_.NearestTo(footprint_.At(Between(from, to, double(i) / steps)));
    if (nearest.distance_m < sweep.min_gap_m) sweep = {nearest.distance_m, nearest.name};
  }
  return sweep;
}

/// How far the base may be moved to a side (1: left, -1: right) on its whole line, walls kept off by the
/// margin.
double DoorPlanner::FreeBeside(const Pose2& from, const Pose2& to, double side, double margin_m) const {
  const Eigen::Vector2d line = to.translation() - from.translation();
  if (line.norm() < kHere_m) return 0;
  const Eigen::Vector2d across = Eigen::Vector2d(-line.y(), line.x()) * (side / line.norm());
  const auto moved = [&](const Pose2& pose, double by_m) {
    return Pose2{pose.x + across.x() * by_m, pose.y + across.y() * by_m, pose.yaw};
  };
  int steps = 0;
  while ((steps + 1) * kLeewayStep_m <= kMostLeeway_m) {
    const double by_m = (steps + 1) * kLeewayStep_m;
    if (SweepAlong(moved(from, by_m), moved(to, by_m), kCoarse).min_gap_m < margin_m) break;
    ++steps;
  }
  return steps * kLeewayStep_m;
}

Outcome<PlannedPath> DoorPlanner::CheckPath(const Pose2& start, std::vector<Pose2> points,
                                            std::size_t n_tight) const {
  const double start_gap_m = obstacles_.NearestTo(footprint_.At(start)).distance_m;
  PlannedPath path{.points = {}, .min_gap_m = start_gap_m};
  Pose2 from = start;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool tight = i + n_tight >= points.size();
    // Who stands nearer to a wall than the margin may leave, but not come nearer still.
    const double margin_m =
        tight ? config_.door_margin_m : std::min(config_.wall_margin_m, start_gap_m * 0.9);
    const Sweep sweep = SweepAlong(from, points[i]);
    if (sweep.min_gap_m < margin_m)
      return Refusal{fmt::format("the path to the door comes within {:.2f} m of {}, it needs {:.2f} m",
                                 sweep.min_gap_m, sweep.obstacle, margin_m)};
    path.min_gap_m = std::min(path.min_gap_m, sweep.min_gap_m);
    path.leeway.push_back(tight ? Leeway{}
                                : Leeway{FreeBeside(from, points[i], 1, config_.wall_margin_m),
                                         FreeBeside(from, points[i], -1, config_.wall_margin_m)});
    from = points[i];
  }
  path.points = std::move(points);
  return path;
}

std::vector<std::vector<Pose2>> DoorPlanner::PassageCandidates(const DoorPlan& door,
                                                               const Pose2& start) const {
  std::vector<std::vector<Pose2>> candidates;
  const auto add = [&](std::vector<Pose2> path_in_door) {
    path_in_door.push_back({config_.goal_m, 0, 0});
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
  if (door.opening_height_m < footprint_.height_m)
    return Refusal{fmt::format("door '{}' is too low: needs {:.2f} m, opening is {:.2f} m", door.name,
                               footprint_.height_m, door.opening_height_m)};
  return std::nullopt;
}

std::optional<Refusal> DoorPlanner::CheckStart(const DoorPlan& door, const Pose2& map_from_start) const {
  const double beyond_m = (door.map_from_door().Inverse() * map_from_start).x - door.FrontX();
  if (beyond_m >= 0)
    return Refusal{fmt::format("the robot is {:.2f} m behind door '{}', not before it", beyond_m, door.name)};
  const auto nearest = obstacles_.NearestTo(footprint_.At(map_from_start));
  if (nearest.distance_m <= 0) return Refusal{"the robot would already be in " + nearest.name};
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
  const double hold_x = std::min(HoldX(door), door_from_start.x);
  // Wherever it may touch, it has come from the hold point: there is no better way.
  return PlannedPath{.points = {door.map_from_door() * Pose2{hold_x, 0, 0}}};
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
