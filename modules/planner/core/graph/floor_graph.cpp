#include "planner/core/graph/floor_graph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// A piece that is so many sigmas off its line is none of it.
constexpr double kOffLine = 6;

}  // namespace

void FloorGraphConfig::Describe(Archive& a) {
  a.Number("key_m", key_m, {"m", 0.1, 5, "driving between two poses of the graph"});
  a.Number("key_deg", key_deg, {"deg", 1, 180, "turning between two poses of the graph"});
  a.Number("walk_m", walk_m, {"m", 0.0005, 0.2, "sigma of the place after a metre"});
  a.Number("turn_deg", turn_deg, {"deg", 0.01, 5, "sigma of the heading after a metre, and after a radian"});
  a.Number("least_m", least_m, {"m", 0.3, 5, "a shorter piece of wall ties nothing together"});
  a.Number("across_m", across_m, {"m", 0.002, 0.5, "sigma of a piece's middle across it"});
  a.Number("yaw_deg", yaw_deg, {"deg", 0.05, 10, "least sigma of a piece's direction"});
  a.Number("edge_m", edge_m, {"m", 0.001, 0.5, "sigma of its ends across it"});
  a.Flag("square", square, "walls are expected to be parallel or perpendicular, when most of them are");
  a.Number("square_rad", prior.sigma_rad, {"rad", 0.0005, 0.2, "sigma of a wall against the axes"});
  a.Number("square_share", square_share, {"-", 0, 1, "of the walls' length that has to be so"});
  a.Number("gate", gate, {"-", 0.5, 10, "Mahalanobis distance up to which two walls may be one"});
  a.Number("apart", apart, {"-", 1, 20, "as far is every other wall that could be meant"});
  a.Number("alone_m", alone_m, {"m", 0.01, 2, "three sigmas; known worse, other walls have to agree"});
  a.Flag("points", points, "corners and edges that are met again tie poses together");
  a.Number("point_m", point_m, {"m", 0.005, 0.5, "least sigma of a point in either direction"});
}

void FloorGraph::Reset() {
  *this = FloorGraph(config_);
}

void FloorGraph::NoteAt(const Pose2& at, double at_s) {
  if (keys_.empty()) {
    newest_ = {at_s, at};
    return AddKey(at, at_s);
  }
  const Pose2 step = newest_.robot_frame_from_base.Inverse() * at;
  driven_m_ += step.translation().norm();
  turned_rad_ += std::abs(step.yaw);
  newest_ = {at_s, at};
  const Pose2 since = keys_.back().robot_frame_from_base.Inverse() * at;
  if (since.translation().norm() >= config_.key_m || std::abs(since.yaw) >= Radians(config_.key_deg))
    AddKey(at, at_s);
}

void FloorGraph::AddKey(const Pose2& at, double at_s) {
  if (keys_.empty()) {
    graph_.AddPose(at);
  } else {
    const Pose2 step = keys_.back().robot_frame_from_base.Inverse() * at;
    const double place_m = 0.001 + config_.walk_m * std::sqrt(driven_m_ + 0.3 * turned_rad_);
    const double yaw = 0.0005 + Radians(config_.turn_deg) * std::sqrt(driven_m_ + turned_rad_);
    const int to = graph_.AddPose(graph_.pose(graph_.poses() - 1) * graph_.bias().Corrected(step));
    graph_.Add(GraphMotion{to - 1, to, step, {place_m, place_m, yaw}});
  }
  keys_.push_back({at_s, at});
  driven_m_ = turned_rad_ = 0;
  changed_ = true;
}

/// The last one that is not later, but for the second by which the time of a wall is rounded.
int FloorGraph::KeyAt(double at_s) const {
  const auto after = std::upper_bound(keys_.begin(), keys_.end(), at_s + 0.5,
                                      [](double t, const Key& key) { return t < key.at_s; });
  return std::max(0, static_cast<int>(after - keys_.begin()) - 1);
}

GraphSight FloorGraph::SightOf(const Told& told) const {
  const double yaw =
      std::hypot(Radians(config_.yaw_deg), std::sqrt(12.0) * config_.edge_m / told.wall.length_m);
  return {told.key, told.line, told.key_from_middle, config_.across_m, yaw};
}

void FloorGraph::Note(const SeenFeature& seen) {
  if (keys_.empty()) return;
  changed_ = true;
  if (!seen.wall()) told_.erase(seen.name());
  if (!seen.point()) points_.erase(seen.name());
  if (const LearnedWall* wall = seen.wall()) NoteWall(seen.name(), *wall);
  if (const LearnedPoint* point = seen.point()) NotePoint(seen, *point);
}

void FloorGraph::NoteWall(const FeatureName& name, const LearnedWall& wall) {
  const auto before = told_.find(name);
  const int key = KeyAt(wall.seen_s);
  const Pose2 key_from_middle =
      keys_[std::size_t(key)].robot_frame_from_base.Inverse() * wall.map_from_wall();
  Told told{key, before == told_.end() ? -1 : before->second.line, key_from_middle, wall};
  if (told.wall.length_m >= config_.least_m) {
    const Pose2 middle = graph_.pose(key) * key_from_middle;
    if (told.line < 0) told.line = graph_.AddLine({middle.translation(), middle.yaw, 0});
    graph_.Add(SightOf(told));
  }
  told_[name] = told;
}

void FloorGraph::NotePoint(const SeenFeature& seen, const LearnedPoint& point) {
  const auto before = points_.find(seen.name());
  GraphPointSight sight{.pose = KeyAt(point.seen_s), .point = -1};
  sight.base_from_point = keys_[std::size_t(sight.pose)].robot_frame_from_base.Inverse() * point.at();
  sight.sigma_m = std::max(config_.point_m, seen.own_sigma_m / std::sqrt(2.0));  // told of both directions
  if (before != points_.end()) sight.point = before->second.sight.point;
  if (sight.point < 0) sight.point = graph_.AddPoint(graph_.pose(sight.pose) * sight.base_from_point);
  if (config_.points) graph_.Add(sight);
  const double towards_rad = seen.towards_rad - keys_[std::size_t(sight.pose)].robot_frame_from_base.yaw;
  points_[seen.name()] = {sight, point, {std::cos(towards_rad), std::sin(towards_rad)}};
}

bool FloorGraph::Settle() {
  constexpr int kMostJoins = 8;
  if (!std::exchange(changed_, false) || keys_.size() < 2) return false;
  TestSquare();
  graph_.Adjust();
  for (int i = 0; i < kMostJoins && JoinOnce(); ++i) {
  }
  return true;
}

/// Most of the length has to lie along two perpendicular axes, and there has to be enough of it.
void FloorGraph::TestSquare() {
  constexpr double kAlong_rad = Radians(4);
  if (!config_.square) return;
  Vector2d sum(0, 0);
  for (const auto& [name, told] : told_)
    if (told.line >= 0) {
      const double turned = 4 * graph_.line(told.line).yaw_rad;
      sum += told.wall.length_m * Vector2d(std::cos(turned), std::sin(turned));
    }
  const double axis = std::atan2(sum.y(), sum.x()) / 4;
  double all_m = 0, along_m = 0;
  for (const auto& [name, told] : told_) {
    if (told.line < 0) continue;
    all_m += told.wall.length_m;
    if (std::abs(std::remainder(graph_.line(told.line).yaw_rad - axis, kPi / 2)) < kAlong_rad)
      along_m += told.wall.length_m;
  }
  graph_.SetSquare(along_m > config_.square_share * all_m ? std::optional(config_.prior) : std::nullopt);
}

/// A piece that its line does not explain lies where it was heard, as does one that is too short.
bool FloorGraph::IsOnLine(const Told& told) const {
  return told.line >= 0 && graph_.DistanceOf(SightOf(told)) < kOffLine;
}

std::map<int, std::vector<WallSpan>> FloorGraph::Spans() const {
  std::map<int, std::vector<WallSpan>> spans;
  for (const auto& [name, told] : told_) {
    if (!IsOnLine(told)) continue;
    const GraphLine& line = graph_.line(told.line);
    const double middle_m = line.AlongTo((graph_.pose(told.key) * told.key_from_middle).translation());
    const double half_m = told.wall.length_m / 2;
    spans[told.line].push_back({middle_m - half_m, middle_m + half_m, told.wall});
  }
  for (auto& [line, pieces] : spans) pieces = JoinedSpans(pieces);
  return spans;
}

Pose2 FloorGraph::map_from_robot() const {
  if (keys_.empty()) return {};
  return graph_.pose(graph_.poses() - 1) * keys_.back().robot_frame_from_base.Inverse();
}

LearnedWalls FloorGraph::Walls() const {
  LearnedWalls walls;
  const auto add = [&](LearnedWall wall, const Pose2& middle, double length_m) {
    wall.id = static_cast<int>(walls.walls.size()) + 1;
    wall.x_m = middle.x;
    wall.y_m = middle.y;
    wall.yaw_deg = Degrees(middle.yaw);
    wall.length_m = length_m;
    wall.sigma_across_m = 0.03;
    wall.sigma_yaw_deg = 0.5;
    wall.rho = 0;
    walls.walls.push_back(wall);
  };
  for (const auto& [index, pieces] : Spans()) {
    const GraphLine& line = graph_.line(index);
    for (const WallSpan& piece : pieces) {
      const Vector2d middle = line.At((piece.from_m + piece.to_m) / 2);
      add(piece.wall, {middle.x(), middle.y(), line.yaw_rad}, piece.to_m - piece.from_m);
    }
  }
  for (const auto& [name, told] : told_)
    if (!IsOnLine(told)) add(told.wall, graph_.pose(told.key) * told.key_from_middle, told.wall.length_m);
  for (const auto& [name, told] : points_) {
    const bool fits = config_.points && graph_.DistanceOf(told.sight) < kOffLine;
    const Vector2d at =
        fits ? graph_.point(told.sight.point) : graph_.pose(told.sight.pose) * told.sight.base_from_point;
    EnterPoint({at.x(), at.y(), told.point.sigma_m, told.point.seen_s}, walls.points);
  }
  return walls;
}

GraphAnchor FloorGraph::AnchorOf(const Pose2& map_from_place) const {
  const int key = graph_.poses() - 1;
  return {key, key < 0 ? map_from_place : graph_.pose(key).Inverse() * map_from_place};
}

Pose2 FloorGraph::PlaceOf(const GraphAnchor& anchor) const {
  return anchor.key < 0 ? anchor.key_from_place : graph_.pose(anchor.key) * anchor.key_from_place;
}

}  // namespace priamos::planner
