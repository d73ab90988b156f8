#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace priamos::planner {

/// Places whose best order is looked for; with more it takes too long.
inline constexpr std::size_t kMostTourPlaces = 10;

/// Which place comes first on the shortest way over all, that ends where it likes: exactly, by dynamic
/// programming over the sets of places that were visited (Held and Karp 1962). `to` [m]: from where the base
/// is to each, kMostTourPlaces at most and one at least; `between`: among them, infinite where there is no
/// way.
std::size_t FirstOfTour(const std::vector<double>& to, const Eigen::MatrixXd& between);

}  // namespace priamos::planner
