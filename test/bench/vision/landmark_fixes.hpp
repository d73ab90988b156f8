#pragma once

#include <vector>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

/// Covariance of (x, y, yaw) of what is believed of the landmark: 20 cm and 5 degrees at most.
Eigen::Matrix3d LookBelief();

/// Error of a pose of the landmark in the base frame, seen along its x axis: depth, lateral, heading.
Eigen::Vector3d ErrorOf(const Pose2& found, const Pose2& truth);

/// Within 3 cm and 1 degree.
bool IsGood(const Eigen::Vector3d& error);

/// 1e9 of no values at all.
double Quantile(std::vector<double> values, double share);

/// As priamos-head tells its finder, with this head's calibration.
head::LandmarkFixOptions Told(const LandmarkLook& look);

/// From the images to the fix, and the time it takes.
struct Fixer {
  head::EdgeOperator edge_operator;
  std::array<head::EdgeImage, 2> edges;
  double seconds = 0, edge_seconds = 0;  ///< all of it; the edge operator's part

  head::LandmarkFix Find(const LandmarkLook& look, const head::LandmarkFixOptions& options,
                         const head::LandmarkModel& model, const std::array<head::CameraModel, 2>& cameras);
};

}  // namespace priamos::bench
