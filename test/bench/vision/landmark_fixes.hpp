#pragma once

#include <vector>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "head/vision_options.hpp"
#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

/// Error of a pose of the landmark in the base frame, seen along its x axis: depth, lateral, heading.
Eigen::Vector3d ErrorOf(const Pose2& found, const Pose2& truth);

/// Whether an error is within 3 cm and 1 degree.
bool IsGood(const Eigen::Vector3d& error);

/// Quantile of values, `share` in 0..1; 1e9 when there are none.
double Quantile(std::vector<double> values, double share);

/// Options that priamos-head gives its finder, with this head's calibration.
head::LandmarkFixOptions Told(const LandmarkLook& look);

/// From the images to the fix, and the time it takes.
struct Fixer {
  head::EdgeOperator edge_operator{head::EdgeOptions(head::VisionConfig())};  ///< as priamos-head has it
  bool with_third = false;  ///< the third camera takes part where the look has its picture
  std::array<head::EdgeImage, 3> edges;
  double seconds = 0, edge_seconds = 0;  ///< all of it; the edge operator's part

  head::LandmarkFix Find(const LandmarkLook& look, const head::LandmarkFixOptions& options,
                         const head::LandmarkModel& model, const std::array<head::CameraModel, 2>& cameras);
};

}  // namespace priamos::bench
