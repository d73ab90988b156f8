#pragma once

#include <optional>
#include <vector>

#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// Which two pieces are taken for one broken edge.
struct FusionOptions {
  double max_gap_px = 24;        ///< longest gap that is bridged
  double max_gap_share = 1.0;    ///< longest gap over the length of the shorter piece
  double max_distance_px = 0.6;  ///< from a piece to the common line, beyond 3 sigma: lenses bend long edges
  double max_angle_rad = 0.02;   ///< angle between two pieces, beyond 3 sigma
  double max_grey_ratio = 2.0;   ///< larger over smaller contrast of the two pieces
};

/// The line of two pieces together, as if it had been fitted to the points of both: a fit is fully described
/// by its weight (1/sigma_normal^2), centre and spread (1/sigma_angle^2), and these add up. Where the pieces
/// contradict each other the standard deviations grow. It has no points of
/// its own: first_point and n_points are 0.
EdgeSegment JoinFits(const EdgeSegment& first, const EdgeSegment& second);

/// Joins broken pieces of one edge (paper, section 4.1): collinear, of the same contrast sign, facing each
/// other or overlapping. The best pair of the whole image is joined first, then the best pair of what is
/// there now, until none is left that fits; pairs are compared by where they lie, so the result
/// does not depend on the order of the input, and fusing again changes nothing. All pieces of a joined edge
/// must lie on it: a slow curve stays in pieces. Needs O(n log n) for n segments of bounded density.
void FuseSegments(const FusionOptions& options, EdgeImage& edges);

}  // namespace priamos::head
