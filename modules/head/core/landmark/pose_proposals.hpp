#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/vertical_stereo.hpp"

namespace priamos::head {

/// A pose of the landmark in the base frame that puts two of its vertical edges onto reconstructed ones.
struct PoseProposal {
  Pose2 base_from_landmark;
  int support = 1;  ///< number of proposals that agree with it
};

/// Which pairs of edges may give a pose, and which poses are merged.
struct ProposalOptions {
  double max_distance_error_m =
      0.03;                  ///< error of the distance of the two edges, beyond 3 sigma of the reconstruction
  double min_base_m = 0.05;  ///< two model edges nearer to each other give no direction
  double gate = 4;           ///< Mahalanobis distance from the prediction, 3 degrees of freedom
  /// Poses this near to each other are one. Nearer than lines that are easily mixed up, such as the frame of
  /// a cupboard's door and the arris 16 mm beside it: of two merged poses only one is tried.
  double merge_m = 0.004, merge_rad = 0.01;
  int max_proposals = 200;
};

/// Candidate poses of the landmark in the base frame.
struct Proposals {
  std::vector<PoseProposal> poses;  ///< most supported first
  int n_tested = 0;                 ///< pairs of pairs that fitted, before merging: the number of trials
};

/// Every pose that lays two visible vertical edges of the model onto two reconstructed ones, as far as the
/// prediction and its covariance of (x, y, yaw) allow it.
Proposals ProposePoses(const LandmarkModel& model, std::span<const int> visible,
                       std::span<const VerticalEdge> verticals, const Pose2& predicted,
                       const Eigen::Matrix3d& covariance, const ProposalOptions& options);

/// Squared Mahalanobis distance of two poses.
double SquaredDistance(const Pose2& a, const Pose2& b, const Eigen::Matrix3d& covariance);

}  // namespace priamos::head
