#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace priamos::head {

/// The place of something that stands still, as all looks that showed it put it together.
struct TrackedPlace {
  Pose2 map_from_thing;
  Eigen::Matrix2d covariance;  ///< of its middle, map frame, without the error of the robot's pose [m^2]
  Eigen::Matrix2d single;      ///< covariance of the look that told its place best [m^2]
  Pose2 map_from_base;         ///< from where it was seen last
};

/// What is known of the motion between looks.
struct PlaceOptions {
  double drift = 0.01;     ///< error of the way driven between two looks, share of its length
  double drift_m = 0.005;  ///< and of each look, beyond what the pictures tell
  double gate = 4;         ///< sigmas; beyond that a thing is put where it was seen last
};

/// Standard deviation of a place [m].
double SigmaOf(const Eigen::Matrix2d& covariance);

/// The place that one look tells, taken from `map_from_base`; its covariance in the base frame.
TrackedPlace PlaceOf(const Pose2& base_from_thing, const Eigen::Matrix2d& covariance,
                     const Pose2& map_from_base, const PlaceOptions& options);

/// Puts a place where it is since the robot's pose was corrected: what was seen moves with who saw it.
void Move(const Pose2& new_from_old, TrackedPlace& place);

/// Weighs the place that a look tells against the one of all before; one that contradicts them takes their
/// place. Returns the weight of the new one, 0 to 1, for what else is to be averaged. Looks are taken for
/// independent but for the drift of the pose between them; an error that all share, as that of the
/// calibration, is in the covariance of each and stays: fused ones are never better than half of the best
/// single one.
double Fuse(const TrackedPlace& seen, const PlaceOptions& options, TrackedPlace& place);

}  // namespace priamos::head
