#pragma once

#include <Eigen/Core>
#include <span>

#include "common/outcome.hpp"
#include "head/core/calibration/resection/point_pair.hpp"

namespace priamos::head {

/// Equations 1-6 of the paper: the DLT matrix (Abdel-Aziz and Karara, 1971) from 6 or more points by
/// homogeneous least squares on normalised coordinates. The result's third row has a direction part of
/// length 1 and gives positive depths before the camera. Refuses fewer than 6 points, numbers that are not
/// finite, points in one plane or otherwise degenerate, points on both sides of the camera, and mirrored
/// images (two swapped columns).
Outcome<Eigen::Matrix<double, 3, 4>> SolveDlt(std::span<const PointPair> pairs);

/// Equation 7: the mean distance between measured and computed image points [px].
double MeanImageError(const Eigen::Matrix<double, 3, 4>& image_from_base, std::span<const PointPair> pairs);

}  // namespace priamos::head
