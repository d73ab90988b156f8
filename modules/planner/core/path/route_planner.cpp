#include "planner/core/path/route_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace priamos::planner {
namespace {

/// Share of its size that a body keeps with which the reason is looked for why there is no way.
constexpr double kSlim = 0.6;
/// Share of the easy margin that straight lines keep.
constexpr double kLines = 0.9;
/// A route that is longer than the straight line times this, and this more, may be a long way round; one that
/// is shorter by this factor is then better.
constexpr double kRoundabout = 1.5, kAround_m = 3;
/// What is no more than so much wider than the base needs is a narrow passage.
constexpr double kNarrow_m = 0.35;
/// Length of the last line to the goal, which has no leeway.
constexpr double kExact_m = 0.6;
/// Floor over which a route is looked for at most: a search keeps 40 kB of each square metre.
constexpr double kMost_m2 = 10000;

ObstacleMap MapOf(const GroundPlan& plan, bool unknown_leaves) {
  ObstacleMap map(plan);
  for (const CupboardPlan& c : plan.cupboards)
    map.Add("cupboard '" + c.name + "'",
            {c.map_from_cupboard() * Pose2{c.depth_m / 2, 0, 0}, {c.depth_m / 2, c.width_m / 2}});
  for (const DoorPlan& door : plan.doors) {
    if (door.leaf == "none" || (door.leaf == "unknown" && !unknown_leaves)) continue;
    const std::string name = "the leaf of door '" + door.name + "'";
    if (door.leaf == "unknown") {
      map.Add(name, {door.map_from_door() * Pose2{door.BackX(), 0, 0},
                     {door.leaf_thickness_m / 2, door.opening_width_m / 2}});
    } else {
      const LeafShape leaf = LeafOf(door, door.leaf, door.leaf_open_deg, door.leaf_thickness_m);
      map.Add(name, {door.map_from_door() * leaf.door_from_leaf, leaf.size_m / 2});
    }
  }
  return map;
}

std::vector<DoorPlan> ClosedDoors(const GroundPlan& plan) {
  std::vector<DoorPlan> closed;
  for (const DoorPlan& door : plan.doors)
    if (door.leaf == "unknown") closed.push_back(door);
  return closed;
}

Footprint Slim(Footprint body) {
  body.length_m *= kSlim;
  body.width_m *= kSlim;
  return body;
}

/// Who stands nearer to a wall than the margin may leave, but not come nearer still.
double LeavingMargin(double margin_m, double start_gap_m) {
  return start_gap_m >= margin_m ? margin_m : 0.9 * start_gap_m;
}

}  // namespace

void RoutePlannerConfig::Describe(Archive& a) {
  a.Number("easy_margin_m", easy_margin_m, {"m", 0, 2, "preferred clearance of a route to everything"});
  a.Number("least_margin_m", least_margin_m, {"m", 0, 1, "clearance where there is no such route"});
  a.Number("least_leeway_m", least_leeway_m,
           {"m", 0, 1, "how far any line may be left, but in a narrow passage"});
  a.Number("turn_m", costs.turn_m, {"m", 0, 10, "what turning by 22.5 degrees costs"});
  a.Number("sideways", costs.sideways,
           {"-", 0, 10, "driving backwards costs so much more, sideways half of it"});
  a.Integer("most_poses", most_poses,
            {"-", 0, 100000000, "poses that a search looks at, for either; 0: all"});
  if (least_margin_m > easy_margin_m) a.Refuse("least_margin_m", "at most easy_margin_m");
}

RoutePlanner::RoutePlanner(const RoutePlannerConfig& config, const Footprint& footprint,
                           const GroundPlan& plan)
    : config_(config),
      doors_(plan.doors),
      closed_(ClosedDoors(plan)),
      known_(footprint, MapOf(plan, true)),
      space_(known_),
      slim_(Slim(footprint), MapOf(plan, false)) {
  Rebuild();
}

void RoutePlanner::Add(std::string name, const Rectangle& shape) {
  added_.push_back({std::move(name), shape});
  Rebuild();
}

void RoutePlanner::Take(std::vector<NamedObstacle> obstacles, const Pose2& map_from_base,
                        std::vector<NamedObstacle> unknown) {
  added_ = std::move(obstacles);
  unknown_ = std::move(unknown);
  EraseUnder(map_from_base, added_);
  EraseUnder(map_from_base, unknown_);
  Rebuild();
}

void RoutePlanner::Forget() {
  added_.clear();
  unknown_.clear();
  Rebuild();
}

void RoutePlanner::Learn(const LearnedWalls& learned, const Pose2& map_from_base) {
  learned_ = ObstaclesOf(learned, known_.obstacles(), doors_);
  EraseUnder(map_from_base, learned_);
  Rebuild();
}

/// Where the base stands is nothing.
void RoutePlanner::EraseUnder(const Pose2& map_from_base, std::vector<NamedObstacle>& obstacles) const {
  const Rectangle body = known_.footprint().At(map_from_base);
  std::erase_if(obstacles, [&](const NamedObstacle& one) { return Distance(body, one.shape) <= 0; });
}

void RoutePlanner::Rebuild() {
  space_ = known_;
  for (const auto* obstacles : {&added_, &learned_})
    for (const NamedObstacle& obstacle : *obstacles) space_.Add(obstacle.name, obstacle.shape);
  const double needed_m = space_.footprint().width_m + 2 * config_.least_margin_m;
  passages_ = NarrowPassagesOf(space_.obstacles(), needed_m, needed_m + kNarrow_m);
  for (const NamedObstacle& obstacle : unknown_) space_.Add(obstacle.name, obstacle.shape);
}

std::string RoutePlanner::InTheWay(const Pose2& map_from_start, const std::vector<Pose2>& points) const {
  constexpr double kTouching_m = 0.01;
  Pose2 from = map_from_start;
  for (const Pose2& to : points) {
    if (!space_.IsFree(from, to, kTouching_m)) return space_.Along(from, to).obstacle;
    from = to;
  }
  return "";
}

Outcome<PlannedPath> RoutePlanner::Plan(const Pose2& map_from_start, const Goal& goal) const {
  if (const auto refusal = CheckEnds(map_from_start, goal)) return *refusal;
  if (auto path = FindPath(map_from_start, goal)) return std::move(*path);
  return NoWay(map_from_start, goal);
}

/// A route with less room around it is taken when one with more is a long way round.
std::optional<PlannedPath> RoutePlanner::FindPath(const Pose2& map_from_start, const Goal& goal) const {
  if (CheckEnds(map_from_start, goal)) return std::nullopt;
  const double middle_m = (config_.easy_margin_m + config_.least_margin_m) / 2;
  const double straight_m = (goal.map_from_base.translation() - map_from_start.translation()).norm();
  std::optional<PlannedPath> best;
  double best_m = std::numeric_limits<double>::infinity();
  for (const double margin_m : {config_.easy_margin_m, middle_m, config_.least_margin_m}) {
    auto path = FindPath(map_from_start, goal, margin_m);
    if (!path) continue;
    const double length_m = LengthOf(map_from_start, path->points);
    if (kRoundabout * length_m < best_m) best_m = length_m, best = std::move(path);
    if (best_m <= kRoundabout * straight_m + kAround_m) break;
  }
  return best;
}

std::optional<PlannedPath> RoutePlanner::FindPath(const Pose2& map_from_start, const Goal& goal,
                                                  double wanted_m) const {
  const double start_gap_m = space_.At(map_from_start).distance_m;
  const double goal_gap_m = goal.turn ? space_.At(goal.map_from_base).distance_m : config_.easy_margin_m;
  const double margin_m = std::min(wanted_m, goal_gap_m);
  const auto route = SearchRoute(space_, {.start = map_from_start,
                                          .goal = goal.map_from_base,
                                          .turn = goal.turn,
                                          .margin_m = margin_m,
                                          .leaving_m = LeavingMargin(margin_m, start_gap_m),
                                          .costs = config_.costs,
                                          .most_poses = config_.most_poses,
                                          .passages = passages_});
  if (!route) return std::nullopt;
  // Lines that had to keep as much as the lattice would have a corner wherever that is all there is.
  const double lines_m = std::max(std::min(margin_m, config_.least_margin_m), kLines * margin_m);
  return PathAlong(map_from_start, Straightened(*route, lines_m));
}

/// One wall far away makes all between it and the robot part of the search.
std::optional<Refusal> RoutePlanner::CheckSize(const Pose2& start, const Goal& goal) const {
  Eigen::AlignedBox2d box = space_.obstacles().Bounds();
  box.extend(start.translation()).extend(goal.map_from_base.translation());
  const Eigen::Vector2d size = box.sizes();
  if (size.prod() <= kMost_m2) return std::nullopt;
  return Refusal{
      fmt::format("the map spans {:.0f} m x {:.0f} m, routes are looked for on {:.0f} m2; next: "
                  "see what lies so far away, priamos map",
                  size.x(), size.y(), kMost_m2)};
}

std::optional<Refusal> RoutePlanner::CheckEnds(const Pose2& start, const Goal& goal) const {
  if (auto too_large = CheckSize(start, goal)) return too_large;
  const Pose2& there = goal.map_from_base;
  const auto gap = space_.At(there);
  if (goal.turn && gap.distance_m < config_.least_margin_m)
    return Refusal{fmt::format("at ({:.2f}, {:.2f}) the base comes within {:.2f} m of {}, it needs {:.2f} m",
                               there.x, there.y, gap.distance_m, gap.obstacle, config_.least_margin_m)};
  const auto nearest = space_.obstacles().NearestTo({there, {0, 0}});
  const double needed_m = space_.footprint().width_m / 2 + config_.least_margin_m;
  if (nearest.distance_m < needed_m)
    return Refusal{fmt::format("the goal ({:.2f}, {:.2f}) is {:.2f} m from {}, its middle needs {:.2f} m",
                               there.x, there.y, nearest.distance_m, nearest.name, needed_m)};
  if (const auto begin = space_.At(start); begin.distance_m <= 0) return StandsIn(start, begin.obstacle);
  return std::nullopt;
}

/// From corner to corner, each the farthest that a straight line reaches; but narrow passages are passed on
/// the lines that the search found.
std::vector<Pose2> RoutePlanner::Straightened(const std::vector<Pose2>& route, double margin_m) const {
  std::vector<Pose2> corners;
  for (std::size_t at = 0; at + 1 < route.size();) {
    std::size_t next = at + 1;
    for (std::size_t to = route.size() - 1; to > next; --to)
      if (!IsNarrow(route[at], route[to]) && space_.IsFree(route[at], route[to], margin_m)) next = to;
    corners.push_back(route[next]);
    at = next;
  }
  return corners;
}

PlannedPath RoutePlanner::PathAlong(const Pose2& start, std::vector<Pose2> corners) const {
  PlannedPath path;
  path.min_gap_m = space_.At(start).distance_m;
  // Around things beside it the base would end beside the goal: the last bit is driven as it is planned.
  const Pose2 before = corners.size() > 1 ? corners[corners.size() - 2] : start;
  const double last_m = (corners.back().translation() - before.translation()).norm();
  if (last_m > kExact_m)
    corners.insert(corners.end() - 1, Between(before, corners.back(), 1 - kExact_m / last_m));
  Pose2 from = start;
  for (const Pose2& to : corners) {
    path.min_gap_m = std::min(path.min_gap_m, space_.Along(from, to).distance_m);
    path.leeway.push_back(LeewayOf(from, to, &to == &corners.back()));
    from = to;
  }
  path.points = std::move(corners);
  return path;
}

bool RoutePlanner::IsNarrow(const Pose2& from, const Pose2& to) const {
  return std::any_of(passages_.begin(), passages_.end(), [&](const NarrowPassage& passage) {
    return passage.Holds(from.translation(), to.translation(), space_.footprint().length_m / 2);
  });
}

std::vector<Leeway> RoutePlanner::LeewayInPassages(const Pose2& map_from_start,
                                                   const std::vector<Pose2>& points,
                                                   const Leeway& elsewhere) const {
  std::vector<Leeway> leeway;
  Pose2 from = map_from_start;
  for (const Pose2& to : points) {
    leeway.push_back(IsNarrow(from, to) ? kNarrowLine : elsewhere);
    from = to;
  }
  return leeway;
}

Leeway RoutePlanner::LeewayOf(const Pose2& from, const Pose2& to, bool exact) const {
  if (IsNarrow(from, to)) return kNarrowLine;
  const Leeway free = exact ? Leeway{} : space_.LeewayOf(from, to, config_.least_margin_m);
  return {std::max(free.left_m, config_.least_leeway_m), std::max(free.right_m, config_.least_leeway_m)};
}

/// Looks for a door on the way that a slim body would take.
Refusal RoutePlanner::NoWay(const Pose2& start, const Goal& goal) const {
  const auto route = SearchRoute(
      slim_, {.start = start, .goal = goal.map_from_base, .turn = false, .margin_m = 0.02, .leaving_m = 0});
  for (std::size_t i = 0; route && i < route->size(); ++i) {
    for (const DoorPlan& door : closed_) {
      const Pose2 there = door.map_from_door().Inverse() * (*route)[i];
      if (std::abs(there.x) < door.wall_thickness_m && std::abs(there.y) < door.opening_width_m / 2)
        return {
            fmt::format("the way to ({:.2f}, {:.2f}) leads through door '{}'; next: priamos mission door {}",
                        goal.map_from_base.x, goal.map_from_base.y, door.name, door.name)};
    }
  }
  return {fmt::format("no way of {:.2f} m width leads to ({:.2f}, {:.2f})",
                      space_.footprint().width_m + 2 * config_.least_margin_m, goal.map_from_base.x,
                      goal.map_from_base.y)};
}

}  // namespace priamos::planner
