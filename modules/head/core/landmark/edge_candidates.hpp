#pragma once

#include <cstdint>
#include <vector>

#include "head/core/landmark/prediction.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A line relative to a predicted edge.
struct EdgeCandidate {
  int line;
  double from, to;       ///< covered part of the prediction [px]
  double before, after;  ///< how far it runs on beyond both ends of the prediction [px]
  double distance;       ///< signed, at the middle of that part [px]
  bool same_sign;        ///< bright side at the prediction's normal
};

/// Finds the lines of one view that run along predicted edges.
class CandidateSearch {
 public:
  /// Lines up to `reach_px` beside the prediction, turned by up to `max_angle_rad`.
  CandidateSearch(const CameraView& view, double reach_px, double max_angle_rad)
      : view_(view), reach_px_(reach_px), max_angle_rad_(max_angle_rad) {}
  /// Appends them to `found`.
  void Find(const PredictedEdge& predicted, std::vector<EdgeCandidate>& found);

 private:
  void MarkNear(const PredictedEdge& edge);

  const CameraView& view_;
  double reach_px_, max_angle_rad_;
  std::vector<std::uint8_t> marks_;
};

}  // namespace priamos::head
