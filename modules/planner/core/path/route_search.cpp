#include "planner/core/path/route_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "planner/core/path/distance_field.hpp"
#include "planner/core/path/passage_lanes.hpp"

namespace priamos::planner {
namespace {

constexpr int kHeadings = 16;
constexpr double kTurn_rad = 2 * kPi / kHeadings;

constexpr double kNear_m = 0.4, kNearWall = 0.5;  ///< so near to an obstacle driving costs up to so much more
/// The estimate of what is left counts so much more than it is: a route may cost so much more than the
/// cheapest one, and is found ten times as fast, for turning and walls always cost more than the estimate
/// knows.
constexpr double kGreed = 1.4;
/// From the start any lattice pose so near can be the first one.
constexpr double kFirst_m = 0.4;
/// A passage so long to either side of its middle is a corridor.
constexpr double kCorridor_m = 0.5;
/// From the start the end of a lane can be the first pose that is so near, and from its end any lattice pose.
constexpr double kFirstLane_m = DistanceField::kFirst_m, kBesideLane_m = 0.15;

constexpr std::array<std::pair<int, int>, 8> kMoves{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// A pose of the lattice.
struct Node {
  int x = 0, y = 0, heading = 0;
};

class Search {
 public:
  Search(const SweptFootprint& space, const RouteQuery& query)
      : space_(space),
        query_(query),
        lanes_(LanesThrough(query.passages, space, query.margin_m)),
        field_(space, query.start.translation(), query.goal.translation(), query.margin_m,
               query.beyond_plan_m, lanes_),
        lattice_(field_.cells() * kHeadings) {}

  std::optional<std::vector<Pose2>> Run() {
    if (!field_.ReachesStart()) return std::nullopt;
    cost_.assign(lattice_ + 2 * lanes_.size(), std::numeric_limits<double>::infinity());
    expanded_.assign(cost_.size(), false);
    from_.assign(cost_.size(), kNone);
    distance_m_.assign(lattice_, -1);
    BeginAtStart();
    int n_poses = 0;
    while (!open_.empty()) {
      const std::size_t index = open_.top().second;
      open_.pop();
      if (expanded_[index]) continue;
      if (query_.most_poses > 0 && ++n_poses > query_.most_poses) return std::nullopt;
      expanded_[index] = true;
      if (index >= lattice_) {
        ExpandLane(index);
      } else if (const Node node = NodeAt(index); IsGoal(node)) {
        return RouteTo(index);
      } else {
        Expand(node, index);
        EnterLanes(index, PoseOf(node));
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t kStart = kNone - 1;

  std::size_t IndexOf(const Node& n) const {
    return field_.IndexOf(n.x, n.y) * kHeadings + std::size_t(n.heading);
  }
  Node NodeAt(std::size_t index) const {
    const auto [x, y] = field_.CellAt(index / kHeadings);
    return {x, y, static_cast<int>(index % kHeadings)};
  }
  /// Headings are counted from the goal's, or if it has none from the start's.
  Pose2 PoseOf(const Node& n) const {
    const Eigen::Vector2d at = field_.PlaceOf(n.x, n.y);
    return {at.x(), at.y(),
            WrapAngle((query_.turn ? query_.goal.yaw : query_.start.yaw) + n.heading * kTurn_rad)};
  }
  Pose2 PoseAt(std::size_t index) const {
    if (index < lattice_) return PoseOf(NodeAt(index));
    const PassageLane& lane = lanes_[(index - lattice_) / 2];
    return (index - lattice_) % 2 == 0 ? lane.before : lane.behind;
  }
  bool IsGoal(const Node& n) const { return n.x == 0 && n.y == 0 && (n.heading == 0 || !query_.turn); }

  void BeginAtStart() {
    const Eigen::Vector2d offset =
        (query_.start.translation() - query_.goal.translation()) / DistanceField::kStep_m;
    const int reach = static_cast<int>(std::ceil(kFirst_m / DistanceField::kStep_m));
    const int x0 = static_cast<int>(std::lround(offset.x())), y0 = static_cast<int>(std::lround(offset.y()));
    for (int x = x0 - reach; x <= x0 + reach; ++x)
      for (int y = y0 - reach; y <= y0 + reach; ++y)
        for (int heading = 0; heading < kHeadings; ++heading)
          if (field_.Holds(x, y)) TryFirst(IndexOf({x, y, heading}), kFirst_m);
    for (std::size_t end = lattice_; end < cost_.size(); ++end) TryFirst(end, kFirstLane_m);
  }

  void TryFirst(std::size_t index, double most_m) {
    TryLine({query_.start, kStart, 0}, index, most_m, std::min(query_.leaving_m, query_.margin_m));
  }

  struct From {
    Pose2 pose;
    std::size_t index;
    double cost;
  };
  /// A straight line to a pose that is no farther, and about as turned.
  void TryLine(const From& from, std::size_t to, double most_m, double margin_m) {
    const Pose2 there = PoseAt(to);
    if (to < lattice_ && IsBarred(from.pose, there)) return;
    const double distance_m = (there.translation() - from.pose.translation()).norm();
    const double turn_rad = std::abs(WrapAngle(there.yaw - from.pose.yaw));
    if (distance_m > most_m || turn_rad > 1.01 * kTurn_rad) return;
    const double cost = from.cost + distance_m + turn_rad / kTurn_rad * query_.costs.turn_m;
    if (cost < cost_[to] && space_.IsFree(from.pose, there, margin_m)) Reach(to, cost, from.index);
  }

  /// An opening that has a lane is passed on it; in a corridor routes begin and end anywhere.
  bool IsBarred(const Pose2& from, const Pose2& to) const {
    return std::any_of(lanes_.begin(), lanes_.end(), [&](const PassageLane& lane) {
      return lane.passage.half_long_m < kCorridor_m &&
             lane.passage.IsCrossedBy(from.translation(), to.translation());
    });
  }

  double ToGoal(std::size_t index) const {
    const Eigen::Vector2i cell = field_.CellOf(PoseAt(index).translation());
    return field_.Holds(cell.x(), cell.y()) ? field_.ToGoal(cell.x(), cell.y())
                                            : std::numeric_limits<double>::infinity();
  }

  void Reach(std::size_t index, double cost, std::size_t from) {
    if (cost >= cost_[index]) return;
    const double to_goal = ToGoal(index);
    if (!std::isfinite(to_goal)) return;
    cost_[index] = cost;
    from_[index] = from;
    open_.push({cost + kGreed * to_goal, index});
  }

  /// Turns and moves follow each other here; straight lines with turning heading replace them afterwards.
  void Expand(const Node& node, std::size_t index) {
    const Pose2 here = PoseOf(node);
    for (const int turn : {-1, 1}) {
      const Node next{node.x, node.y, (node.heading + turn + kHeadings) % kHeadings};
      if (IsBetter(next, cost_[index] + query_.costs.turn_m) && TurnIsFree(index, here, next))
        Reach(IndexOf(next), cost_[index] + query_.costs.turn_m, index);
    }
    for (const auto& [dx, dy] : kMoves) {
      const Node next{node.x + dx, node.y + dy, node.heading};
      if (!field_.Holds(next.x, next.y)) continue;
      const double ahead = std::cos(std::atan2(dy, dx) - here.yaw),
                   length_m = std::hypot(dx, dy) * DistanceField::kStep_m;
      const double cost =
          cost_[index] + length_m * (1 + query_.costs.sideways * (1 - ahead) / 2) * NearWall(next.x, next.y);
      if (IsBetter(next, cost) && MoveIsFree(index, here, next, length_m)) Reach(IndexOf(next), cost, index);
    }
  }

  void EnterLanes(std::size_t from, const Pose2& here) {
    for (std::size_t end = lattice_; end < cost_.size(); ++end)
      if ((PoseAt(end).translation() - here.translation()).cwiseAbs().maxCoeff() < kBesideLane_m)
        TryLine({here, from, cost_[from]}, end, kBesideLane_m, query_.margin_m);
  }

  /// To its other end, and to the lattice beside it. In its middle walls are as far off as they can be: no
  /// line of the lattice that just fits is better.
  void ExpandLane(std::size_t index) {
    const Pose2 here = PoseAt(index);
    const bool ahead = (index - lattice_) % 2 == 0;
    const std::size_t other = ahead ? index + 1 : index - 1;
    const double length_m = (PoseAt(other).translation() - here.translation()).norm();
    Reach(other, cost_[index] + length_m * (ahead ? 1 : 1 + query_.costs.sideways), index);
    const Eigen::Vector2i cell = field_.CellOf(here.translation());
    for (int x = cell.x() - 1; x <= cell.x() + 1; ++x)
      for (int y = cell.y() - 1; y <= cell.y() + 1; ++y)
        for (int heading = 0; heading < kHeadings; ++heading)
          if (field_.Holds(x, y))
            TryLine({here, index, cost_[index]}, IndexOf({x, y, heading}), kBesideLane_m, query_.margin_m);
  }

  bool IsBetter(const Node& next, double cost) const {
    return cost < cost_[IndexOf(next)] && std::isfinite(field_.ToGoal(next.x, next.y));
  }

  double LeastAtEnds(std::size_t from, const Pose2& here, const Node& next) {
    return std::min(DistanceAt(from, here), DistanceAt(IndexOf(next), PoseOf(next)));
  }

  /// Half way no point is farther than half of the turn from where it is at the nearer end.
  bool TurnIsFree(std::size_t from, const Pose2& here, const Node& next) {
    if (field_.SurelyFree(next.x, next.y)) return true;
    const double least_m = LeastAtEnds(from, here, next);
    if (least_m < query_.margin_m) return false;
    return least_m > query_.margin_m + kTurn_rad * space_.radius_m() / 2 ||
           space_.IsFree(here, PoseOf(next), query_.margin_m);
  }

  /// Where an obstacle is nearest on a straight move, the nearer end is at most half of the move away: by
  /// Pythagoras the distances at both ends tell enough.
  bool MoveIsFree(std::size_t from, const Pose2& here, const Node& next, double length_m) {
    if (field_.SurelyFree(next.x, next.y)) return true;
    if (IsBarred(here, PoseOf(next))) return false;
    return LeastAtEnds(from, here, next) >= std::hypot(query_.margin_m, length_m / 2);
  }

  double DistanceAt(std::size_t index, const Pose2& pose) {
    float& distance_m = distance_m_[index];
    if (distance_m < 0) distance_m = static_cast<float>(space_.DistanceAt(pose));
    return distance_m;
  }

  double NearWall(int x, int y) const {
    const double spare_m = field_.Clearance(x, y) - space_.footprint().width_m / 2 - query_.margin_m;
    return 1 + kNearWall * std::clamp(1 - spare_m / kNear_m, 0.0, 1.0);
  }

  std::vector<Pose2> RouteTo(std::size_t index) const {
    std::vector<Pose2> route;
    for (std::size_t i = index; i != kStart; i = from_[i]) route.push_back(PoseAt(i));
    route.push_back(query_.start);
    std::reverse(route.begin(), route.end());
    return route;
  }

  const SweptFootprint& space_;
  const RouteQuery& query_;
  std::vector<PassageLane> lanes_;
  DistanceField field_;
  std::size_t lattice_;  ///< poses of the lattice; then come both ends of each lane
  std::vector<double> cost_;
  std::vector<bool> expanded_;
  std::vector<std::size_t> from_;
  std::vector<float> distance_m_;  ///< from the footprint there to the nearest obstacle; -1: not asked yet
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
};

}  // namespace

std::optional<std::vector<Pose2>> SearchRoute(const SweptFootprint& space, const RouteQuery& query) {
  return Search(space, query).Run();
}

}  // namespace priamos::planner
