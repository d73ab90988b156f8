#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "robot/core/base/footprint.hpp"
#include "robot/core/motion/detour_line.hpp"
#include "robot/core/motion/path_shape.hpp"

namespace priamos::robot {

/// Between two places of a search over lanes [m], along the path and beside it.
inline constexpr double kLaneStep_m = 0.05;

/// The middle [m] of the lane in which a distance to the left of the path lies.
double MiddleOfLane(double offset_m);

/// What a search over lanes beside a path is given: see FindDetour.
struct LaneSearch {
  const DetourConfig& config;
  const Footprint& footprint;
  const PathShape& path;
  std::span<const Eigen::Vector2d> things;  ///< map frame [m]
  const Detour& last;
  Things taken;
};

/// Where a way may begin: how far to the left of the path [m], and what it costs to get there, as metres of
/// the path.
struct LaneBegin {
  double offset_m = 0, cost = 0;
};

/// A way over lanes: the arc length at which it begins, and its distances to the left of the path from there
/// on, a step apart.
struct LaneWay {
  double from_m = 0;
  std::vector<double> offsets_m;
  bool leads_on = false;  ///< see Detour
};

/// The same as a line for a base that begins `off_m` to the left of the middle of its lane.
Detour DetourOver(const LaneWay& way, double off_m);

/// Whether the path itself leads near nothing from the arc length `from_m` to `to_m`.
bool IsFree(const LaneSearch& search, double from_m, double to_m);

/// The cheapest way as far as the arc length `to_m`, or as far as one leads, from one of `begins`, the k-th
/// of which is k steps behind `from_m`: dynamic programming over distances along the path and beside it.
/// nullopt: there is none.
std::optional<LaneWay> SearchLanes(const LaneSearch& search, double from_m, double to_m,
                                   std::span<const std::optional<LaneBegin>> begins);

}  // namespace priamos::robot
