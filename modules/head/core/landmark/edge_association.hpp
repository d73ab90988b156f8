#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// An edge of the model found in one image.
struct EdgeMatch {
  int edge = 0, camera = 0;
  std::vector<int> lines;   ///< CameraView::lines of one contrast sign that together make it
  double covered = 0;       ///< share of the predicted length they cover, 0..1
  double distance_px = 0;   ///< mean distance from the prediction, to the right of its direction positive
  double predicted_px = 0;  ///< predicted length
  double log_odds = 0;      ///< part of Association::log_odds
  double overshoot_px = 0;  ///< how far the image edge runs on where the model has an end
  /// How far the image edge ends before the prediction's from and to end; negative: it runs on.
  std::array<double, 2> gap_px{};
  double grey_ratio = 0;  ///< measured value of LandmarkEdge::grey_ratio
};

/// A corner of the model both of whose edges were found in one image.
struct CornerMatch {
  int a = 0, b = 0, camera = 0;  ///< edges a and b, and the image
  double log_odds = 0;           ///< part of Association::log_odds: whether the edges end in the corner
};

/// Evidence of the images for one supposed pose.
struct Association {
  double missed_log_odds = 0;  ///< log odds of a whole edge that is not found
  std::vector<EdgeMatch> matches;
  std::vector<CornerMatch> corners;
  int n_predicted = 0;       ///< edges that should be seen, all images together
  double log_odds = 0;       ///< logarithm of p(images | landmark there) / p(images | clutter only)
  double best_log_odds = 0;  ///< what a perfect match would give
  /// Evidence by side of the landmark (LandmarkEdge::side): lengths that should be seen and that were found,
  /// each edge counted up to kFullLengthPx [px].
  std::array<double, 4> side_predicted_px{}, side_found_px{};

  /// Takes the match of one model edge in one image (-1: in all) back: what was found is something else.
  void Withdraw(const LandmarkModel& model, int edge, int camera);
};

/// Which image edge may belong to which model edge, and the statistics that give the odds.
struct AssociationOptions {
  double sigma_px = 0.5;  ///< expected distance of an image edge from the right prediction
  double gate_px = 1.5;   ///< image edges farther from the prediction do not belong to it
  double max_angle_rad = 0.05;
  double detection = 0.85;  ///< chance that the operator finds an edge that is there
  double clutter_window_px =
      40;  ///< half width of the strip in which the density of similar edges is measured
  double min_covered = 0.15;
  double min_separation_px = 5;  ///< model edges seen nearer to each other are left out, both
  double grey_sigma = 0.35;      ///< measured minus modelled grey_ratio: lighting
  double any_grey_sigma = 0.7;   ///< measured grey_ratio of any edge, about 0
  double grey_surprise = 0.1;    ///< share of edges beside which there is something else
  double corner_px = 6;          ///< edges that end so near to a corner end in it
  /// Share of corners in which both edges end: 0.62 were measured of doors, 0.11 of cupboards, whose edges
  /// get lost in their own shadow; and where there is no corner (0.06, 0).
  double corner_detection = 0.4, corner_chance = 0.06;
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
