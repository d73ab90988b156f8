#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry.hpp"
#include "common/robot/leeway.hpp"

namespace priamos::planner {

/// Where a base is to go, map frame.
struct Goal {
  Pose2 map_from_base;
  bool turn = true;              ///< the heading counts; else it arrives as suits its path
  std::vector<Pose2> instead{};  ///< places that do as well when it cannot be reached, best first
};

/// The most points that the robot takes in one PATH.
inline constexpr std::size_t kMostPathPoints = 16;

/// A line may be left by so much at least where the place of the base, or the map, is not known as well as a
/// line that may not be left; and where the base came by a hand's breadth from something it has to dodge on
/// its way back.
inline constexpr double kLeastLeeway_m = 0.1;

/// Length of the straight lines from `start` over all `points` [m].
inline double LengthOf(const Pose2& start, const std::vector<Pose2>& points) {
  double length_m = 0;
  Eigen::Vector2d from = start.translation();
  for (const Pose2& to : points) {
    length_m += (to.translation() - from).norm();
    from = to.translation();
  }
  return length_m;
}

/// A path in the map frame, the start left out.
struct PlannedPath {
  std::vector<Pose2> points;
  std::vector<Leeway> leeway{};  ///< of the line to each point: what the plan leaves free; missing ones are 0
  double min_gap_m = 0;          ///< smallest planned distance to an obstacle, start to end
  bool centre = false;           ///< keep to the middle between the walls that are heard; of one point
};

/// As much of a path as the robot takes in one PATH, from its start.
inline PlannedPath FirstPart(PlannedPath path) {
  if (path.points.size() > kMostPathPoints) path.points.resize(kMostPathPoints);
  if (path.leeway.size() > kMostPathPoints) path.leeway.resize(kMostPathPoints);
  return path;
}

}  // namespace priamos::planner
