#include "planner/core/missions/door_views.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/locate/leg_choice.hpp"
#include "planner/core/map/door_sides.hpp"

namespace priamos::planner {
namespace {

/// Doors nearer to each other, and turned less, could be taken for each other from a place that is known to
/// some decimetres.
constexpr double kAlike_m = 1.0, kAlike_rad = 0.6;
/// Places before a door from which both jambs are seen: so far from its middle, so far off its axis.
constexpr double kFar_m[] = {2.0, 1.6, 2.5, 1.3, 3.0}, kSlant_rad[] = {0, 0.4, -0.4, 0.75, -0.75};
constexpr double kNearest_m = 1.2, kFarthest_m = 3.2, kMostSlant_rad = 0.8;
/// The head turns so far from straight ahead.
constexpr double kMostBearing_rad = 1.5;
/// Facing it where there is room, else along its wall.
constexpr double kTurned_rad[] = {0, kPi / 2, -kPi / 2};
/// What makes a view worse, in metres driven: slant and turning [1/rad], another distance [1/m], what hides
/// it.
constexpr double kBySlant_m = 1, kByTurning_m = 0.4, kByDistance = 0.4, kByHidden_m = 4;
constexpr double kBestFar_m = 2.0;
/// And each other place that it does not tell.
constexpr double kByAlike_m = 2;
/// From nearer to a place that was tried nothing else is seen.
constexpr double kSame_m = 0.5;
/// And what hid the door from there, its own leaf for instance, hides it from the same side again: a view at
/// the same slant costs so much more, one at this difference none.
constexpr double kBySameSlant_m = 2, kOtherSlant_rad = 0.7;
/// Ways that are looked for: where these cannot be reached, the others hardly can.
constexpr int kMostWays = 8;

bool IsSpent(int door_id, const Pose2& door_from_base, const std::vector<SpentView>& spent) {
  return std::any_of(spent.begin(), spent.end(), [&](const SpentView& s) {
    return s.door_id == door_id &&
           (s.door_from_base.translation() - door_from_base.translation()).norm() < kSame_m;
  });
}

double SlantOf(const Pose2& door_from_base) {
  return std::atan2(door_from_base.y, -door_from_base.x);
}

/// What a view costs for being like those that were tried.
double CostOfSameSlant(int door_id, const Pose2& door_from_base, const std::vector<SpentView>& spent) {
  double cost = 0;
  for (const SpentView& s : spent) {
    if (s.door_id != door_id) continue;
    const double other = std::abs(SlantOf(s.door_from_base) - SlantOf(door_from_base)) / kOtherSlant_rad;
    cost += kBySameSlant_m * std::max(0.0, 1 - other);
  }
  return cost;
}

/// Whether one of the lines stands between a place and one of the jambs; what lies on the door's wall does
/// not.
bool IsHidden(const DoorPlan& door, const Eigen::Vector2d& from, const std::vector<ScreenLine>& lines) {
  constexpr double kBeforeWall_m = 0.25, kStep_m = 0.08;
  for (const double side : {-0.5, 0.5}) {
    const Eigen::Vector2d jamb =
        door.map_from_door() * Eigen::Vector2d(-kBeforeWall_m, side * door.opening_width_m);
    const int steps = 1 + static_cast<int>((jamb - from).norm() / kStep_m);
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector2d at = from + (jamb - from) * i / steps;
      for (const ScreenLine& line : lines)
        if (DistanceToSegment(line.from, line.to, at) < kStep_m) return true;
    }
  }
  return false;
}

/// Whether it is the side that a door is not drawn from.
bool IsFarSide(const DoorPlan& door, const GroundPlan& plan) {
  return std::any_of(plan.doors.begin(), plan.doors.end(),
                     [&](const DoorPlan& d) { return d.behind_id != 0 && d.behind_id == door.id; });
}

}  // namespace

DoorViews::DoorViews(const RoutePlannerConfig& config, const Footprint& footprint, const GroundPlan& plan)
    : planner_(config, footprint, plan), doors_(DoorSides(plan)) {
  for (const DoorPlan& door : doors_)
    if (IsFarSide(door, plan)) behind_.push_back(door.id);
  for (const WallPlan& wall : plan.walls) walls_.push_back({wall.from(), wall.to()});
}

bool DoorViews::IsInSight(const Pose2& door_from_base) {
  const double far_m = door_from_base.translation().norm();
  const Eigen::Vector2d ahead = door_from_base.Inverse().translation();
  return far_m >= kNearest_m && far_m <= kFarthest_m && std::abs(SlantOf(door_from_base)) <= kMostSlant_rad &&
         std::abs(std::atan2(ahead.y(), ahead.x())) <= kMostBearing_rad;
}

bool DoorViews::AreAtOnePlace(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() < kAlike_m &&
         std::abs(WrapAngle(a.yaw - b.yaw)) < kAlike_rad;
}

void DoorViews::Know(const LearnedWalls& heard, const std::vector<Rectangle>& things,
                     const std::vector<Rectangle>& echoes, const Pose2& place) {
  std::vector<NamedObstacle> obstacles;
  screens_.clear();
  for (const Rectangle& thing : things) {
    obstacles.push_back({"what stopped the robot", thing});
    const auto corners = thing.Corners();
    screens_.push_back({corners[0], corners[2]});
    screens_.push_back({corners[1], corners[3]});
  }
  for (const Rectangle& echo : echoes) obstacles.push_back({"what was heard near", echo});
  for (const LearnedWall& wall : heard.walls) screens_.push_back({wall.from(), wall.to()});
  planner_.Take(std::move(obstacles), place);
  planner_.Learn(heard, place);
}

bool DoorViews::HasDoor(const Pose2& map_from_door) const {
  return std::any_of(doors_.begin(), doors_.end(),
                     [&](const DoorPlan& d) { return AreAtOnePlace(d.map_from_door(), map_from_door); });
}

bool DoorViews::IsBehind(const DoorPlan& side) const {
  return std::find(behind_.begin(), behind_.end(), side.id) != behind_.end();
}

/// The places that have a door where a base at `place` sees this one.
std::size_t DoorViews::CountAlike(const DoorPlan& door, const Pose2& place, const std::vector<Pose2>& others,
                                  Sides sides) const {
  const Pose2 base_from_door = place.Inverse() * door.map_from_door();
  const auto is_alike = [&](const Pose2& other) {
    return std::any_of(doors_.begin(), doors_.end(), [&](const DoorPlan& d) {
      return (sides == Sides::kAlike || IsBehind(d) == IsBehind(door)) &&
             AreAtOnePlace(d.map_from_door(), other * base_from_door);
    });
  };
  return static_cast<std::size_t>(std::count_if(others.begin(), others.end(), is_alike));
}

bool DoorViews::Tells(const DoorPlan& door, const Pose2& place, const std::vector<Pose2>& others,
                      Sides sides) const {
  return others.empty() || CountAlike(door, place, others, sides) < others.size();
}

bool DoorViews::IsView(const DoorPlan& door, const Pose2& there, const std::vector<SpentView>& spent) const {
  const Pose2 door_from_base = door.map_from_door().Inverse() * there;
  return IsInSight(door_from_base) && !IsSpent(door.id, door_from_base, spent) &&
         !IsHidden(door, there.translation(), walls_);
}

/// Of a view, without the way to it.
double DoorViews::CostOf(const DoorPlan& door, const Pose2& there,
                         const std::vector<SpentView>& spent) const {
  const Pose2 at = door.map_from_door().Inverse() * there;
  return kBySlant_m * std::abs(SlantOf(at)) + kByDistance * std::abs(at.translation().norm() - kBestFar_m) +
         CostOfSameSlant(door.id, at, spent) +
         (IsHidden(door, there.translation(), screens_) ? kByHidden_m : 0);
}

void DoorViews::AddSpots(const DoorPlan& door, const Pose2& place, const std::vector<SpentView>& spent,
                         std::vector<Spot>& spots) const {
  const auto add = [&](const Pose2& door_from_base) {
    const Pose2 there = door.map_from_door() * door_from_base;
    if (!IsView(door, there, spent) || !planner_.IsFree(there)) return false;
    const double way = (there.translation() - place.translation()).norm() +
                       kByTurning_m * std::abs(WrapAngle(there.yaw - place.yaw));
    spots.push_back({&door, there, way + CostOf(door, there, spent)});
    return true;
  };
  for (const double far_m : kFar_m)
    for (const double slant_rad : kSlant_rad) {
      const double x_m = -far_m * std::cos(slant_rad), y_m = far_m * std::sin(slant_rad);
      add({x_m, y_m, WrapAngle(place.yaw - door.map_from_door().yaw)});
      for (const double turned_rad : kTurned_rad)
        if (add({x_m, y_m, turned_rad})) break;
    }
}

/// Where the base was it can be again, whatever seems to be there, and turn to the door.
void DoorViews::AddTrail(const DoorPlan& door, const std::vector<Pose2>& trail,
                         const std::vector<SpentView>& spent, std::vector<Spot>& spots) const {
  double back_m = 0;
  for (std::size_t i = trail.size(); i-- > 0;) {
    if (i + 1 < trail.size()) back_m += (trail[i + 1].translation() - trail[i].translation()).norm();
    Pose2 there = trail[i];
    double turning = 0;
    if (!IsView(door, there, spent)) {
      const Eigen::Vector2d ahead = door.map_from_door().translation() - there.translation();
      there.yaw = std::atan2(ahead.y(), ahead.x());
      turning = kByTurning_m * std::abs(WrapAngle(there.yaw - trail[i].yaw));
      if (!IsView(door, there, spent)) continue;
    }
    spots.push_back({&door, there, back_m + turning + CostOf(door, there, spent), i});
  }
}

std::optional<PlannedPath> DoorViews::WayTo(const Spot& spot, const std::vector<Pose2>& trail) const {
  PlannedPath path;
  if (!spot.of_trail) {
    auto route = planner_.FindPath(trail.back(), {spot.there, true});
    if (!route) return std::nullopt;
    path = std::move(*route);
    path.leeway.resize(path.points.size());
    for (Leeway& leeway : path.leeway)
      leeway = {std::max(kLeastLeeway_m, leeway.left_m), std::max(kLeastLeeway_m, leeway.right_m)};
    return path;
  }
  const bool turns = std::abs(WrapAngle(spot.there.yaw - trail[*spot.of_trail].yaw)) > 1e-6;
  if (*spot.of_trail + 1 < trail.size()) path.points = AlongTrail(trail, trail.size() - 1, *spot.of_trail);
  if (turns) path.points.push_back(spot.there);
  path.leeway.assign(path.points.size(), {kLeastLeeway_m, kLeastLeeway_m});
  return path;
}

std::optional<DoorView> DoorViews::Here(const Pose2& place, const std::vector<Pose2>& others,
                                        const std::vector<SpentView>& spent, Sides sides) const {
  std::optional<DoorView> best;
  double least = INFINITY;
  for (const DoorPlan& door : doors_) {
    if (!Tells(door, place, others, sides) || !IsView(door, place, spent)) continue;
    const double cost = CostOf(door, place, spent);
    if (cost >= least || IsHidden(door, place.translation(), screens_)) continue;
    least = cost;
    best = DoorView{door, door.map_from_door().Inverse() * place, {}};
  }
  return best;
}

std::optional<DoorView> DoorViews::Best(const std::vector<Pose2>& trail, const std::vector<Pose2>& others,
                                        const std::vector<SpentView>& spent, Sides sides) const {
  std::vector<Spot> spots;
  for (const DoorPlan& door : doors_) {
    if (!Tells(door, trail.back(), others, sides)) continue;
    const std::size_t first = spots.size(), alike = CountAlike(door, trail.back(), others, sides);
    AddTrail(door, trail, spent, spots);
    AddSpots(door, trail.back(), spent, spots);
    for (std::size_t i = first; i < spots.size(); ++i) spots[i].cost += kByAlike_m * double(alike);
  }
  std::stable_sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.cost < b.cost; });
  int ways = 0;
  for (const Spot& spot : spots) {
    if (!spot.of_trail && ++ways > kMostWays) continue;
    if (auto path = WayTo(spot, trail))
      return DoorView{*spot.door, spot.door->map_from_door().Inverse() * spot.there, std::move(*path)};
  }
  return std::nullopt;
}

}  // namespace priamos::planner
