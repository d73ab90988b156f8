#pragma once

#include <Eigen/Core>

#include "common/geometry.hpp"

namespace priamos::robot {

/// Residual and Jacobian of one measurement of a landmark at the time of the picture (paper,
/// section 6.2.1).
struct LandmarkCorrection {
  double rotation_rad = 0;  ///< equation 8, with its sign: to be added to the estimated heading
  Eigen::Vector2d displacement_m{0,
                                 0};  ///< equation 9, map frame: to be subtracted from the estimated position
};

/// Correction of the pose by one landmark. `base_from_landmark` is X_rec, `map_from_landmark` X_mod. Equation
/// 8 takes the angle between the modelled and the reconstructed direction of the landmark from its cosine;
/// here from both components, which keeps the sign and loses no digits near 0. Equation 9 turns X_rec, seen
/// from the estimated position, by that angle and subtracts X_mod.
LandmarkCorrection CorrectionFrom(const Pose2& map_from_base, const Pose2& base_from_landmark,
                                  const Pose2& map_from_landmark);

/// The pose after the correction, as if the measurement were exact: map_from_landmark *
/// base_from_landmark^-1.
Pose2 Corrected(const Pose2& map_from_base, const LandmarkCorrection& correction);

/// Where a landmark must appear in the base frame when the base is at `map_from_base`, as (x, y, yaw), and
/// the derivative of that with respect to (x, y, yaw) of the base.
struct ExpectedMeasurement {
  Pose2 base_from_landmark;
  Eigen::Matrix3d by_pose;
};
ExpectedMeasurement PredictMeasurement(const Pose2& map_from_base, const Pose2& map_from_landmark);

}  // namespace priamos::robot
