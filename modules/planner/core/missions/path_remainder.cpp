#include "planner/core/missions/path_remainder.hpp"

#include <algorithm>
#include <limits>

#include "common/geometry.hpp"

namespace priamos::planner {
namespace {

/// Farther than this beyond its last report no robot comes to rest.
constexpr double kBeyondReport_m = 0.8;
/// Of the reported distance on the radio.
constexpr double kRounding_m = 0.02;

Eigen::Vector2d Begin(const PathOrder& path, const Pose2& start, std::size_t line) {
  return line == 0 ? start.translation() : path.points[line - 1].translation();
}

}  // namespace

PathOrder RemainderOf(const PathOrder& path, const Pose2& start, double remaining_m,
                      const Pose2& map_from_base) {
  std::size_t nearest = path.points.empty() ? 0 : path.points.size() - 1;
  double nearest_m = std::numeric_limits<double>::infinity(), after_m = 0;
  // From the end of the path to the line that the robot was on when it reported last.
  for (std::size_t i = path.points.size(); i-- > 0 && after_m <= remaining_m + kRounding_m;) {
    const Eigen::Vector2d from = Begin(path, start, i), to = path.points[i].translation();
    const bool may_be_there = after_m + (to - from).norm() >= remaining_m - kBeyondReport_m;
    const double distance_m = DistanceToSegment(from, to, map_from_base.translation());
    if (may_be_there && distance_m <= nearest_m) {
      nearest = i;
      nearest_m = distance_m;
    }
    after_m += (to - from).norm();
  }
  PathOrder left = path;
  left.points.erase(left.points.begin(), left.points.begin() + std::ptrdiff_t(nearest));
  const std::size_t gone = std::min(nearest, left.leeway.size());
  left.leeway.erase(left.leeway.begin(), left.leeway.begin() + std::ptrdiff_t(gone));
  return left;
}

}  // namespace priamos::planner
