#include "planner/core/path/narrow_passages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// Walls so parallel make a corridor, and not an opening.
constexpr double kParallel_rad = Radians(3);
/// Passages whose middles are so near to each other, in about one direction, are one.
constexpr double kSamePlace_m = 0.2, kSameWay_rad = Radians(15);
/// Obstacles that meet at an edge are equally near to the middle of the passage beside it.
constexpr double kAsNear_m = 0.01;

/// A line is looked at in such steps.
constexpr double kSampled_m = 0.05;

using Ends = std::pair<Vector2d, Vector2d>;

/// Between disjoint rectangles a corner of one of them is always among the nearest points.
Ends NearestPoints(const Rectangle& a, const Rectangle& b) {
  Ends nearest;
  double distance_m = std::numeric_limits<double>::infinity();
  const auto take = [&](const Vector2d& on_a, const Vector2d& on_b) {
    if ((on_b - on_a).norm() >= distance_m) return;
    distance_m = (on_b - on_a).norm();
    nearest = {on_a, on_b};
  };
  for (const Vector2d& corner : a.Corners()) take(corner, b.NearestTo(corner));
  for (const Vector2d& corner : b.Corners()) take(a.NearestTo(corner), corner);
  return nearest;
}

/// Along the x axis of a frame.
struct Span {
  double low_m = std::numeric_limits<double>::infinity(), high_m = -low_m;
};

Span SpanOf(const Rectangle& shape, const Pose2& map_from_frame) {
  Span span;
  for (const Vector2d& corner : shape.Corners()) {
    const double x = (map_from_frame.Inverse() * corner).x();
    span = {std::min(span.low_m, x), std::max(span.high_m, x)};
  }
  return span;
}

bool AreParallel(const Rectangle& a, const Rectangle& b) {
  const double quarters = (a.map_from_centre.yaw - b.map_from_centre.yaw) / (kPi / 2);
  return std::abs(quarters - std::round(quarters)) * kPi / 2 < kParallel_rad;
}

NarrowPassage PassageBetween(const Rectangle& a, const Rectangle& b) {
  const auto [on_a, on_b] = NearestPoints(a, b);
  const Vector2d across = on_b - on_a, middle = (on_a + on_b) / 2;
  NarrowPassage passage{{middle.x(), middle.y(), std::atan2(-across.x(), across.y())}, across.norm()};
  if (!AreParallel(a, b)) return passage;
  const Span of_a = SpanOf(a, passage.map_from_passage), of_b = SpanOf(b, passage.map_from_passage);
  const double low_m = std::max(of_a.low_m, of_b.low_m), high_m = std::min(of_a.high_m, of_b.high_m);
  if (high_m <= low_m) return passage;
  passage.map_from_passage = passage.map_from_passage * Pose2{(low_m + high_m) / 2, 0, 0};
  passage.half_long_m = (high_m - low_m) / 2;
  return passage;
}

/// An obstacle near another one.
struct Neighbour {
  double distance_m = 0;  ///< between the boxes around both
  std::size_t index = 0;
};

/// Of each obstacle those whose boxes are no farther away, the nearest first: a sweep along x, for a building
/// has a thousand of them.
std::vector<std::vector<Neighbour>> NeighboursWithin(const ObstacleMap& obstacles, double most_m) {
  std::vector<std::pair<Eigen::AlignedBox2d, std::size_t>> boxes;
  for (std::size_t i = 0; i < obstacles.size(); ++i) boxes.emplace_back(obstacles.BoundsOf(i), i);
  std::sort(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.min().x(), a.second) < std::pair(b.first.min().x(), b.second);
  });
  std::vector<std::vector<Neighbour>> near(obstacles.size());
  for (auto a = boxes.begin(); a != boxes.end(); ++a)
    for (auto b = a + 1; b != boxes.end() && b->first.min().x() - a->first.max().x() <= most_m; ++b) {
      const double distance_m = a->first.exteriorDistance(b->first);
      if (distance_m > most_m) continue;
      near[a->second].push_back({distance_m, b->second});
      near[b->second].push_back({distance_m, a->second});
    }
  for (auto& of_one : near)
    std::sort(of_one.begin(), of_one.end(), [](const Neighbour& a, const Neighbour& b) {
      return std::pair(a.distance_m, a.index) < std::pair(b.distance_m, b.index);
    });
  return near;
}

/// Whether nothing is nearer to the middle of a passage than its sides. What is would be near the obstacle of
/// one side, too; where obstacles are crowded one of the nearest is.
bool IsFree(const NarrowPassage& passage, const std::vector<Neighbour>& near_side,
            const ObstacleMap& obstacles) {
  const Vector2d middle = passage.map_from_passage.translation();
  for (const Neighbour& other : near_side) {
    if (other.distance_m > passage.width_m) return true;
    if (obstacles.DistanceTo(other.index, middle) < passage.width_m / 2 - kAsNear_m) return false;
  }
  return true;
}

bool AreOne(const NarrowPassage& a, const NarrowPassage& b) {
  const Pose2 there = a.map_from_passage.Inverse() * b.map_from_passage;
  const double turned = std::abs(WrapAngle(there.yaw));
  return there.translation().norm() < kSamePlace_m && std::min(turned, kPi - turned) < kSameWay_rad;
}

}  // namespace

bool NarrowPassage::IsCrossedBy(const Vector2d& from, const Vector2d& to) const {
  const Pose2 passage_from_map = map_from_passage.Inverse();
  const Vector2d a = passage_from_map * from, b = passage_from_map * to;
  if ((a.x() < 0) == (b.x() < 0)) return false;
  return std::abs(a.y() + (b.y() - a.y()) * a.x() / (a.x() - b.x())) < width_m / 2;
}

bool NarrowPassage::Holds(const Vector2d& from, const Vector2d& to, double half_body_m) const {
  const Pose2 passage_from_map = map_from_passage.Inverse();
  const Vector2d a = passage_from_map * from, b = passage_from_map * to;
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kSampled_m)));
  for (int i = 0; i <= steps; ++i) {
    const Vector2d at = a + (b - a) * (double(i) / steps);
    if (std::abs(at.x()) < half_long_m + half_body_m && std::abs(at.y()) < width_m / 2) return true;
  }
  return false;
}

std::vector<NarrowPassage> NarrowPassagesOf(const ObstacleMap& obstacles, double least_m, double most_m) {
  std::vector<NarrowPassage> passages;
  const auto near = NeighboursWithin(obstacles, most_m);
  for (std::size_t i = 0; i < near.size(); ++i)
    for (const Neighbour& other : near[i]) {
      if (other.index < i) continue;  // the same pair
      const auto passage = PassageBetween(obstacles.ShapeOf(i), obstacles.ShapeOf(other.index));
      if (passage.width_m < least_m || passage.width_m > most_m) continue;
      if (IsFree(passage, near[i], obstacles)) passages.push_back(passage);
    }
  std::stable_sort(passages.begin(), passages.end(),
                   [](const NarrowPassage& a, const NarrowPassage& b) { return a.width_m < b.width_m; });
  std::vector<NarrowPassage> narrowest;
  for (const NarrowPassage& passage : passages) {
    const auto is_it = [&](const NarrowPassage& other) { return AreOne(passage, other); };
    if (std::none_of(narrowest.begin(), narrowest.end(), is_it)) narrowest.push_back(passage);
  }
  return narrowest;
}

}  // namespace priamos::planner
