#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/geometry.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// An upright edge that stands beyond a landmark, on no plan: an arris of a shelf, a corner of the room, the
/// frame of a picture.
struct FarEdge {
  Eigen::Vector2d at{0, 0};                              ///< place on the floor, landmark frame [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of that place [m^2]
  double bottom_m = 0, top_m = 0;                        ///< heights between which it was seen
  bool bright_right = false;                             ///< of its two sides, as it was seen
};

/// Which edges are kept, and which pieces of different looks are one.
struct FarEdgeOptions {
  double beyond_m = 0.6;        ///< behind the landmark's plane: nearer ones may be its own
  double most_m = 15;           ///< from the base
  double most_share = 0.08;     ///< of the distance: standard deviation of the place along the line of sight
  double least_height_m = 0.1;  ///< of a piece
  double same_m = 0.02;         ///< across the line of sight, beyond 3 sigmas
  std::size_t most = 60;        ///< edges of one landmark
};

/// What looks at a landmark showed beyond it. A fix tells where the landmark is, so each look tells where
/// such edges are in the landmark's frame; later, when the landmark itself is too near to be seen, they tell
/// the heading.
class FarEdges {
 public:
  explicit FarEdges(const FarEdgeOptions& options = {}) : options_(options) {}

  /// Takes the upright edges of a look's matches, as seen from where its fix has the base. `left`: the view
  /// to which StereoMatch::left belongs.
  void Learn(const LandmarkFix& fix, const CameraView& left, std::span<const StereoMatch> matches);
  const std::vector<FarEdge>& edges() const { return edges_; }
  /// Variance of the heading of the best fix by which they were learnt: errors that later looks repeat
  /// [rad^2].
  double heading_variance() const { return heading_variance_; }

 private:
  void Add(const FarEdge& edge, const Eigen::Vector2d& viewer);

  FarEdgeOptions options_;
  std::vector<FarEdge> edges_;
  double heading_variance_ = 0;
};

}  // namespace priamos::head
