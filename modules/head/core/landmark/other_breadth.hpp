#pragma once

#include <Eigen/Geometry>
#include <span>

#include "head/core/landmark/edge_odds.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// How much better than `seen` at its pose the images show the same landmark with its left or its right side
/// 4 to 20 cm elsewhere, as that of another landmark of the kind would be: difference of the log odds,
/// negative when `seen` explains them better than all of these. `visible` lists the edges to expect.
double LeadOfOtherBreadth(const LandmarkModel& seen, std::span<const int> visible,
                          std::span<const CameraView> views, const Eigen::Isometry3d& base_from_landmark,
                          const AssociationOptions& options);

}  // namespace priamos::head
