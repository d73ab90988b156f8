#include "planner/core/path/door_router.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

#include "planner/core/map/door_sides.hpp"

namespace priamos::planner {
namespace {

/// Places before a door are tried from the farthest one inwards, in such steps.
constexpr double kStep_m = 0.1;
constexpr std::size_t kNone = std::size_t(-1);

}  // namespace

void DoorRouterConfig::Describe(Archive& a) {
  a.Number("before_m", before_m,
           {"m", 1, 10, "place on a door's axis from which it is passed, if there is room"});
  a.Number("slant_deg", slant_deg, {"deg", 0, 60, "aside of a door's axis from where it is passed at once"});
  a.Number("turned_deg", turned_deg,
           {"deg", 0, 90, "turned to a door's axis with which it is passed at once"});
  a.Number("door_costs_m", door_costs_m, {"m", 0, 1000, "a door costs as much as so long a detour"});
}

DoorRouter::DoorRouter(const DoorRouterConfig& config, const RoutePlannerConfig& route,
                       const DoorPlannerConfig& passage, const Footprint& footprint, const GroundPlan& plan)
    : config_(config), route_(route, footprint, plan), passage_(passage, footprint, plan) {
  for (const DoorPlan& door : plan.doors) {
    AddPassage(door, door.id);
    const DoorPlan behind = FromBehind(door);
    if (door.behind_id != 0 || passage_.CabinPlace(behind))
      AddPassage(behind, door.id);
    else
      closed_.push_back(fmt::format("door '{}' has no landmark on its far side (behind_id)", door.name));
  }
}

void DoorRouter::AddPassage(const DoorPlan& door, int door_id) {
  Passage passage{door, door_id, std::nullopt, door.map_from_door() * Pose2{passage_.GoalX(door), 0, 0}};
  if (const auto refusal = passage_.CheckDoor(door)) {
    closed_.push_back(refusal->reason);
  } else if (const auto cabin = passage_.CabinPlace(door)) {
    passage.before = cabin;
    passage.is_cabin = true;
  } else if (const auto places = PlacesBefore(door); places.empty()) {
    closed_.push_back(fmt::format("there is no room to stand before door '{}'", door.name));
  } else {
    passage.before = places.front();
    passage.nearer.assign(places.begin() + 1, places.end());
  }
  passages_.push_back(std::move(passage));
}

/// Places on the axis from which the way to the hold point is free, the farthest first. What is not on the
/// plan may make the first ones useless.
std::vector<Pose2> DoorRouter::PlacesBefore(const DoorPlan& door) const {
  std::vector<Pose2> places;
  const double hold_x = passage_.HoldX(door);
  for (double x = std::min(-config_.before_m, hold_x); x <= hold_x + 1e-9; x += kStep_m) {
    const Pose2 place = door.map_from_door() * Pose2{x, 0, 0};
    if (route_.IsFree(place) && passage_.PlanApproach(door, place)) places.push_back(place);
  }
  return places;
}

/// Whether the door mission can begin at a place, however slanted it is.
bool DoorRouter::CanBegin(const Passage& passage, const Pose2& map_from_base) const {
  const Outcome<PlannedPath> path = passage.is_cabin ? passage_.PlanLeave(passage.door, map_from_base)
                                                     : passage_.PlanApproach(passage.door, map_from_base);
  return static_cast<bool>(path);
}

bool DoorRouter::StandsBefore(const Passage& passage, const Pose2& map_from_base) const {
  if (passage.is_cabin) return CanBegin(passage, map_from_base);
  const Pose2 there = passage.door.map_from_door().Inverse() * map_from_base;
  return there.x <= passage_.HoldX(passage.door) + kStep_m &&
         std::atan2(std::abs(there.y), -there.x) <= Radians(config_.slant_deg) &&
         std::abs(there.yaw) <= Radians(config_.turned_deg) && CanBegin(passage, map_from_base);
}

std::optional<double> DoorRouter::LengthTo(const Passage& passage, const Pose2& from) const {
  if (!passage.before) return std::nullopt;
  if (StandsBefore(passage, from)) return 0;
  const auto path = route_.FindPath(from, {*passage.before});
  return path ? std::optional(LengthOf(from, path->points)) : std::nullopt;
}

std::optional<double> DoorRouter::LengthBetween(std::size_t from_passage, std::size_t to_passage) {
  const auto key = std::pair(from_passage, to_passage);
  const auto known = between_.find(key);
  if (known != between_.end()) return known->second;
  return between_[key] = LengthTo(passages_[to_passage], passages_[from_passage].behind);
}

void DoorRouter::AppendLegs(const Passage& passage, const Pose2& from, double to_door_m,
                            std::vector<Leg>& legs) const {
  const Pose2 begin = to_door_m > 0 ? *passage.before : from;
  if (to_door_m > 0) legs.push_back({std::nullopt, {begin, true, passage.nearer}, to_door_m});
  const double through_m = (passage.behind.translation() - begin.translation()).norm();
  legs.push_back({passage.door_id, {passage.behind}, through_m});
}

/// Dijkstra's search over passages: each is a node, which is reached when the base is behind the door.
class DoorRouter::Search {
 public:
  Search(DoorRouter& router, const Pose2& start, const Goal& goal)
      : router_(router), start_(start), goal_(goal), nodes_(router.passages_.size()) {}

  /// The legs of the shortest way; empty: there is none.
  std::vector<Leg> Run() {
    Finish(kNone, 0, start_);
    // A way without a door that is shorter than one door costs needs no search.
    if (best_m_ > router_.config_.door_costs_m) OfferFromStart();
    while (!open_.empty() && open_.top().first < best_m_) {
      const auto [cost_m, node] = open_.top();
      open_.pop();
      if (cost_m <= nodes_[node].cost_m) Expand(node);
    }
    return best_m_ < kFar ? Legs() : std::vector<Leg>{};
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  struct Node {
    double cost_m = kFar;
    std::size_t from = kNone;
    double to_door_m = 0;  ///< length of the drive to where the passage begins
  };

  void OfferFromStart() {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      Offer(i, kNone, 0, router_.LengthTo(router_.passages_[i], start_));
  }
  void Offer(std::size_t node, std::size_t from, double cost_m, std::optional<double> to_door_m) {
    if (!to_door_m) return;
    cost_m += *to_door_m + router_.config_.door_costs_m;
    if (cost_m >= nodes_[node].cost_m) return;
    nodes_[node] = {cost_m, from, *to_door_m};
    open_.push({cost_m, node});
  }
  void Expand(std::size_t node) {
    const double cost_m = nodes_[node].cost_m;
    Finish(node, cost_m, router_.passages_[node].behind);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (i != node) Offer(i, node, cost_m, router_.LengthBetween(node, i));
  }
  /// The drive to the goal after the last door.
  void Finish(std::size_t node, double cost_m, const Pose2& from) {
    const auto path = router_.route_.FindPath(from, goal_);
    const double length_m = path ? LengthOf(from, path->points) : kFar;
    if (cost_m + length_m >= best_m_) return;
    best_m_ = cost_m + length_m;
    last_ = node;
    last_m_ = length_m;
  }
  std::vector<Leg> Legs() const {
    std::vector<std::size_t> doors;
    for (std::size_t i = last_; i != kNone; i = nodes_[i].from) doors.push_back(i);
    std::vector<Leg> legs;
    Pose2 from = start_;
    for (auto i = doors.rbegin(); i != doors.rend(); ++i) {
      router_.AppendLegs(router_.passages_[*i], from, nodes_[*i].to_door_m, legs);
      from = router_.passages_[*i].behind;
    }
    legs.push_back({std::nullopt, goal_, last_m_});
    return legs;
  }

  DoorRouter& router_;
  Pose2 start_;
  Goal goal_;
  std::vector<Node> nodes_;
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  double best_m_ = kFar, last_m_ = 0;
  std::size_t last_ = kNone;  ///< last door of the best way
};

Outcome<std::vector<Leg>> DoorRouter::Plan(const Pose2& map_from_start, const Goal& goal) {
  if (const auto refusal = route_.CheckEnds(map_from_start, goal)) return *refusal;
  std::vector<Leg> legs = Search(*this, map_from_start, goal).Run();
  if (!legs.empty()) return legs;
  if (closed_.empty()) return Refusal{route_.Plan(map_from_start, goal).reason()};
  return Refusal{fmt::format("no way leads to ({:.2f}, {:.2f}): {}", goal.map_from_base.x,
                             goal.map_from_base.y, fmt::join(closed_, "; "))};
}

std::vector<Leg> DoorRouter::PlanThrough(const Pose2& map_from_start, int door_id) {
  std::vector<Leg> best;
  double best_m = std::numeric_limits<double>::infinity();
  for (const Passage& passage : passages_) {
    if (passage.door_id != door_id) continue;
    std::vector<Leg> legs = LegsThrough(passage, map_from_start);
    double length_m = 0;
    for (const Leg& leg : legs) length_m += leg.length_m;
    if (legs.empty() || length_m >= best_m) continue;
    best_m = length_m;
    best = std::move(legs);
  }
  if (best.empty()) best.push_back({door_id, {map_from_start}, 0});
  return best;
}

/// What the door mission does from here is tried first, however slanted it is.
std::vector<Leg> DoorRouter::LegsThrough(const Passage& passage, const Pose2& from) {
  std::vector<Leg> legs;
  const bool on_its_side = (passage.door.map_from_door().Inverse() * from).x <= 0;
  if (on_its_side && CanBegin(passage, from)) {
    AppendLegs(passage, from, 0, legs);
  } else if (passage.before) {
    const auto way = Plan(from, {*passage.before});
    if (!way) return {};
    legs = *way;
    legs.back().goal.instead = passage.nearer;
    AppendLegs(passage, *passage.before, 0, legs);
  }
  return legs;
}

std::optional<Pose2> DoorRouter::PlaceInCabin(int door_id) const {
  const auto out = std::ranges::find_if(
      passages_, [&](const Passage& passage) { return passage.is_cabin && passage.door_id == door_id; });
  return out == passages_.end() ? std::nullopt : out->before;
}

std::string DoorRouter::NameOf(int door_id) const {
  for (const Passage& passage : passages_)
    if (passage.door_id == door_id) return passage.door.name;
  return fmt::format("{}", door_id);
}

}  // namespace priamos::planner
