#pragma once

#include <bitset>
#include <vector>

#include "common/archive.hpp"
#include "robot/core/pose/wall_update.hpp"

namespace priamos::robot {

/// The face of a straight wall as the plan has it, map frame; on the way from `from` to `to` it is to the
/// right. Either end may lie beside its place, across the wall, independently of the other.
struct PlanWall {
  Eigen::Vector2d from{0, 0}, to{1, 0};
  double sigma_m = 0.05;  ///< of the place of either end

  Eigen::Vector2d along() const { return (to - from).normalized(); }
  Eigen::Vector2d normal() const { return {along().y(), -along().x()}; }  ///< towards the wall
  double length_m() const { return (to - from).norm(); }
};

/// When a wall of the state is one of the plan.
struct PlanMatchConfig {
  double gate_distance = 3;   ///< Mahalanobis distance of its direction and place from the plan's
  double apart_distance = 5;  ///< as far off is every other wall of the plan
  double alone_m = 0.2;  ///< three sigmas of the place; when it is known worse the wall opposite has to agree
  double every_s = 1;    ///< time between two comparisons

  void Describe(Archive& a);
};

/// Wall number `wall` of the state is this one of the plan.
struct PlanMatch {
  int wall = 0;
  PlanWall plan;
};

/// The walls of the state, of those that are `heard`, that are surely walls of the plan. A wall is taken
/// alone where nothing that stands 15 cm before it could be taken for it; where the pose is not known so
/// well, only together with the wall opposite: the distance between the two does not depend on the pose.
std::vector<PlanMatch> MatchPlan(const PoseState& state, const std::bitset<PoseState::kMostWalls>& heard,
                                 const std::vector<PlanWall>& plan, const PlanMatchConfig& config);

/// Kalman update of the state by a wall's place on the plan. Its error is the same at each look, so that it
/// counts once (split covariance intersection).
PoseState Updated(const PoseState& prior, const PlanMatch& match);

}  // namespace priamos::robot
