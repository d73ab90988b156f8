#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/stand/upright_votes.hpp"

namespace priamos::head {

/// Whether edges tell which direction is up, or why not.
enum class UprightVerdict {
  kFound,
  kTooFew,     ///< no more edges agree on a direction than would by chance
  kAmbiguous,  ///< two directions have nearly as many edges
  kVague,      ///< the edges that agree are next to each other, or too short
};

/// In plain words.
const char* Describe(UprightVerdict verdict);

/// Where the images of all upright edges meet, the vertical vanishing point, as a direction of space.
struct VerticalDirection {
  UprightVerdict verdict = UprightVerdict::kTooFew;
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();        ///< unit; frame of the first camera: y is down in it
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of `up`, none along it
  int n_edges = 0;                                       ///< that agree
  /// Level directions in which many edges run, the heavier one first: those of walls. Unit; two at most,
  /// at any angle.
  std::vector<Eigen::Vector3d> walls{};
};

/// The direction in which most upright edges of calibrated cameras agree: votes of pairs of the longest
/// edges, then least squares over all that agree. The views' common frame is the first camera's own (x right,
/// y down, z forward); several views are used as one. All but `verdict` and `n_edges` is valid with kFound
/// only.
VerticalDirection FindVertical(std::span<const CameraView> views, const UprightOptions& options);

}  // namespace priamos::head
