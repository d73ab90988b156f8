#pragma once

#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "planner/core/path/narrow_passages.hpp"
#include "planner/core/path/swept_footprint.hpp"

namespace priamos::planner {

/// What a way costs beside its length, in metres driven forward.
struct RouteCosts {
  double turn_m = 0.15;    ///< turning by a heading of the lattice, 22.5 degrees
  double sideways = 0.15;  ///< a metre driven backwards costs so much more, sideways half of it
};

/// From where to where a route is wanted, map frame.
struct RouteQuery {
  Pose2 start, goal;
  bool turn = true;          ///< the goal's heading counts; else any will do
  double margin_m = 0.1;     ///< least distance to every obstacle ...
  double leaving_m = 0.1;    ///< ... and on the first 40 cm, for a base that stands nearer to one
  double beyond_plan_m = 3;  ///< how far outside the obstacles and both ends it may lead
  RouteCosts costs{};
  int most_poses = 0;  ///< after so many poses the search ends without a route; 0: when there are no more
  std::vector<NarrowPassage> passages{};  ///< through which it may lead although the lattice does not fit
};

/// A quick route of the true footprint on a lattice of poses: places 10 cm apart, 16 headings, counted
/// from the goal so that it ends there exactly, and on straight lines through the middles of narrow passages,
/// for which neither places nor headings of the lattice need fit. Weighted A* with the distance around the
/// obstacles as heuristic; it prefers to drive forward and to keep off walls. Returns start, lattice poses
/// and goal; nullopt: there is no such route. Every pose is looked at once at most, so it always ends.
std::optional<std::vector<Pose2>> SearchRoute(const SweptFootprint& space, const RouteQuery& query);

}  // namespace priamos::planner
