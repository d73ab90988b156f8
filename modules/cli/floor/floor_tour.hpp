#pragma once

#include <Eigen/Core>
#include <vector>

#include "cli/floor/true_floor.hpp"

namespace priamos::cli {

/// A way of who knows the floor.
struct FloorTour {
  double length_m = 0;  ///< from the start over all places, and not back
  int places = 0;
};

/// The best way found from the start to places from which 98 % of what can be reached is seen: the places by
/// greedy covering (Chvatal 1979), their order by 2-opt (Croes 1958) and Or-opt (Or 1976) from the nearest
/// neighbours and from random orders. An upper bound of the best one: a way sees between its places as well.
FloorTour TourOf(const TrueFloor& floor, const Eigen::Vector2d& start);

/// The shortest order found of the places that begins with the first; `apart_m[i][k]` between two of them.
/// `restarts` random orders are improved as well, the same ones each time.
std::vector<int> ShortestOrder(const std::vector<std::vector<double>>& apart_m, int restarts);
double LengthOf(const std::vector<int>& order, const std::vector<std::vector<double>>& apart_m);

}  // namespace priamos::cli
