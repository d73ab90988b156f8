#pragma once

#include <array>
#include <vector>

#include "head/core/landmark/edge_candidates.hpp"
#include "head/core/landmark/edge_odds.hpp"
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
  std::array<bool, 2> is_end_in_view{};  ///< from, to; false: the border of the image cuts the edge there
  double grey_ratio = 0;                 ///< measured value of LandmarkEdge::grey_ratio
  bool is_measured = true;  ///< false: evidence that the edge is there, too far off to measure the pose by
};

/// The candidates of `predicted` in `view` that make it, of the contrast sign that is more likely, as one
/// match of the model's `edge`; nothing is covered when none lies within the gate.
EdgeMatch MatchEdge(const std::vector<EdgeCandidate>& candidates, const PredictedEdge& predicted,
                    const LandmarkEdge& edge, const CameraView& view, const AssociationOptions& options);

}  // namespace priamos::head
