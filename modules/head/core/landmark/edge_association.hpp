#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "head/core/landmark/edge_match.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A corner of the model both of whose edges were found in one image.
struct CornerMatch {
  int a = 0, b = 0, camera = 0;  ///< edges a and b, and the image
  double log_odds = 0;           ///< part of Association::log_odds: whether the edges end in the corner
};

/// Shorter predictions count less, longer ones as this.
inline constexpr double kFullLength_px = 40;

/// Evidence of the images for one supposed pose.
struct Association {
  double missed_log_odds = 0;  ///< log odds of a whole edge that is not found
  std::vector<EdgeMatch> matches;
  std::vector<CornerMatch> corners;
  int n_predicted = 0;       ///< edges that should be seen, all images together
  double log_odds = 0;       ///< logarithm of p(images | landmark there) / p(images | clutter only)
  double best_log_odds = 0;  ///< what a perfect match would give
  /// Evidence by side of the landmark (LandmarkEdge::side): lengths that should be seen and that were found,
  /// each edge counted up to kFullLength_px [px].
  std::array<double, 4> side_predicted_px{}, side_found_px{};

  /// Takes the match of one model edge in one image (-1: in all) back: what was found is something else.
  void Withdraw(const LandmarkModel& model, int edge, int camera);
  /// Keeps the match as evidence, and does not measure by it.
  void SetAside(int edge, int camera);
  /// Matches that are measured by.
  int Measuring() const;
};

/// Compares the model's edges at `base_from_landmark` with the edges of all images. `visible` lists the model
/// edges to expect. The odds of an edge: how much better "there" explains an image edge of that length so
/// near the prediction than the density of similar edges around it does; an edge that is not found counts
/// against. A movable part stands as the model has it or elsewhere, either as likely: found, all of it counts
/// for the pose; not found, it does not count.
Association Associate(const LandmarkModel& model, std::span<const int> visible,
                      std::span<const CameraView> views, const Eigen::Isometry3d& base_from_landmark,
                      const AssociationOptions& options);

}  // namespace priamos::head
