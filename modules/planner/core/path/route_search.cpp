#include "planner/core/path/route_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "planner/core/path/distance_field.hpp"

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
        field_(space, query.start.translation(), query.goal.translation(), query.margin_m,
               query.beyond_plan_m),
        cost_(field_.cells() * kHeadings, std::numeric_limits<double>::infinity()),
        expanded_(field_.cells() * kHeadings, false),
        from_(field_.cells() * kHeadings, kNone),
        distance_m_(field_.cells() * kHeadings, -1) {}

  std::optional<std::vector<Pose2>> Run() {
    BeginAtStart();
    int n_poses = 0;
    while (!open_.empty()) {
      const std::size_t index = open_.top().second;
      open_.pop();
      if (expanded_[index]) continue;
      if (query_.most_poses > 0 && ++n_poses > query_.most_poses) return std::nullopt;
      expanded_[index] = true;
      const Node node = NodeAt(index);
      if (IsGoal(node)) return RouteTo(index);
      Expand(node, index);
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
  bool IsGoal(const Node& n) const { return n.x == 0 && n.y == 0 && (n.heading == 0 || !query_.turn); }

  void BeginAtStart() {
    const Eigen::Vector2d offset =
        (query_.start.translation() - query_.goal.translation()) / DistanceField::kStep_m;
    const int reach = static_cast<int>(std::ceil(kFirst_m / DistanceField::kStep_m));
    const int x0 = static_cast<int>(std::lround(offset.x())), y0 = static_cast<int>(std::lround(offset.y()));
    for (int x = x0 - reach; x <= x0 + reach; ++x)
      for (int y = y0 - reach; y <= y0 + reach; ++y)
        for (int heading = 0; heading < kHeadings; ++heading) TryFirst({x, y, heading});
  }

  void TryFirst(const Node& node) {
    if (!field_.Holds(node.x, node.y)) return;
    const Pose2 pose = PoseOf(node);
    const double distance_m = (pose.translation() - query_.start.translation()).norm();
    const double turn_rad = std::abs(WrapAngle(pose.yaw - query_.start.yaw));
    if (distance_m > kFirst_m || turn_rad > 1.01 * kTurn_rad) return;
    if (!space_.IsFree(query_.start, pose, std::min(query_.leaving_m, query_.margin_m))) return;
    Reach(node, distance_m + turn_rad / kTurn_rad * query_.costs.turn_m, kStart);
  }

  void Reach(const Node& node, double cost, std::size_t from) {
    const std::size_t index = IndexOf(node);
    if (cost >= cost_[index]) return;
    const double to_goal = field_.ToGoal(node.x, node.y);
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
        Reach(next, cost_[index] + query_.costs.turn_m, index);
    }
    for (const auto& [dx, dy] : kMoves) {
      const Node next{node.x + dx, node.y + dy, node.heading};
      if (!field_.Holds(next.x, next.y)) continue;
      const double ahead = std::cos(std::atan2(dy, dx) - here.yaw),
                   length_m = std::hypot(dx, dy) * DistanceField::kStep_m;
      const double cost =
          cost_[index] + length_m * (1 + query_.costs.sideways * (1 - ahead) / 2) * NearWall(next.x, next.y);
      if (IsBetter(next, cost) && MoveIsFree(index, here, next, length_m)) Reach(next, cost, index);
    }
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
    for (std::size_t i = index; i != kStart; i = from_[i]) route.push_back(PoseOf(NodeAt(i)));
    route.push_back(query_.start);
    std::reverse(route.begin(), route.end());
    return route;
  }

  const SweptFootprint& space_;
  const RouteQuery& query_;
  DistanceField field_;
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
