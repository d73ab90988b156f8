#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// One edge of a picture as an operator sees it; the kinds are those of view_edge_t.
struct ViewedEdge {
  /// What an edge is to the fix.
  enum Kind {
    kPredicted = 0,  ///< where the robot's pose puts an edge of the model
    kMatched = 1,    ///< seen, and taken for an edge of the model
    kRejected = 2    ///< seen where an edge of the model might be, and not taken for it
  };
  Kind kind = kPredicted;
  Eigen::Vector2d p, q;  ///< ends [undistorted px]
};

/// What was seen of a landmark in one picture.
struct LandmarkView {
  int camera = 0;                 ///< 0 left, 1 right
  std::vector<ViewedEdge> edges;  ///< by kind; rejected ones by weight
  int n_left_out = 0;             ///< rejected edges beyond LandmarkViewOptions::max_rejected
};

/// How much of a picture is shown.
struct LandmarkViewOptions {
  int max_rejected = 14;     ///< more would fill the picture, and the radio
  double search_sigmas = 3;  ///< half width of the strip about a prediction, in its standard deviations
  double beside_px = 4;      ///< added to that half width for errors of edge operator and model
  double max_angle_rad = 0.15;
};

/// The camera whose picture explains the verdict better: the left one if the landmark was found, else the one
/// with fewer matches.
int CameraToShow(const LandmarkFix& fix);

/// Predicted, matched and rejected edges of one picture; `camera` is its number in `fix.matches`. Rejected
/// are edges in the strip that the covariance of the prediction lays about a predicted edge; those beside the
/// pose that was fitted weigh double. `prediction` is what the finder was given.
LandmarkView ViewLandmark(const LandmarkModel& model, const LandmarkPrediction& prediction,
                          const LandmarkFix& fix, const CameraView& picture, int camera,
                          const LandmarkViewOptions& options = {});

}  // namespace priamos::head
