#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/stand/upright_votes.hpp"

namespace priamos::head {

/// Up to two level directions in which most of `edges` run, if `up` is about upwards: the heavier one first.
/// Unit vectors across `up`.
std::vector<Eigen::Vector3d> FindLevelDirections(std::span<const UprightVote> edges,
                                                 const Eigen::Vector3d& up);

/// A frame whose third column is upwards, and level directions in it.
struct LevelFrame {
  Eigen::Vector3d up;
  std::vector<Eigen::Vector3d> walls;                    ///< unit, across `up`
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of `up`, none along it
  int n_upright = 0, n_level = 0;                        ///< edges that agree
};

/// The direction upwards under which steep edges are upright and the others run along level directions as
/// far as they do: robust least squares of all together, from `start`. What agrees with neither counts for
/// nothing. A frame without edges of both kinds is returned as it was, with no covariance.
LevelFrame FitLevelFrame(std::span<const UprightVote> steep, std::span<const UprightVote> others,
                         const LevelFrame& start, const UprightOptions& options);

}  // namespace priamos::head
