#pragma once

#include <Eigen/Core>
#include <vector>

namespace priamos::bench {

/// How far a disc around the origin gets in a direction [rad] before it meets one of the points, at most
/// `most_m`. One that lies in a point already may only leave it.
double FreeRange(const std::vector<Eigen::Vector2d>& points, double radius_m, double direction_rad,
                 double most_m);

/// The same for `n` directions around, of which number k is DirectionOf(k, n), from -pi to pi.
std::vector<double> FreeRanges(const std::vector<Eigen::Vector2d>& points, double radius_m, std::size_t n,
                               double most_m);
double DirectionOf(std::size_t k, std::size_t n);

/// Distance from the edge of a disc at `at` to the nearest point, 0 to `most_m`.
double ClearanceAt(const std::vector<Eigen::Vector2d>& points, double radius_m, const Eigen::Vector2d& at,
                   double most_m);

}  // namespace priamos::bench
