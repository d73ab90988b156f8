#include "test/bench/rivals/free_ranges.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::bench {

double DirectionOf(std::size_t k, std::size_t n) {
  return kPi * (2 * (double(k) + 0.5) / double(n) - 1);
}

double FreeRange(const std::vector<Eigen::Vector2d>& points, double radius_m, double direction_rad,
                 double most_m) {
  const Eigen::Vector2d along(std::cos(direction_rad), std::sin(direction_rad));
  double free_m = most_m;
  for (const Eigen::Vector2d& point : points) {
    const double ahead_m = point.dot(along);
    if (ahead_m <= 0) continue;
    const double square = radius_m * radius_m - (point.squaredNorm() - ahead_m * ahead_m);
    if (square > 0) free_m = std::min(free_m, std::max(0.0, ahead_m - std::sqrt(square)));
  }
  return free_m;
}

std::vector<double> FreeRanges(const std::vector<Eigen::Vector2d>& points, double radius_m, std::size_t n,
                               double most_m) {
  std::vector<double> ranges(n);
  for (std::size_t k = 0; k < n; ++k) ranges[k] = FreeRange(points, radius_m, DirectionOf(k, n), most_m);
  return ranges;
}

double ClearanceAt(const std::vector<Eigen::Vector2d>& points, double radius_m, const Eigen::Vector2d& at,
                   double most_m) {
  double least_m = most_m;
  for (const Eigen::Vector2d& point : points) least_m = std::min(least_m, (point - at).norm() - radius_m);
  return std::max(0.0, least_m);
}

}  // namespace priamos::bench
