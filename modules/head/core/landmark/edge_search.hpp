#pragma once

#include <span>
#include <vector>

#include "head/core/landmark/edge_association.hpp"
#include "head/core/landmark/edge_candidates.hpp"

namespace priamos::head {

inline constexpr double kNearlyWhole = 0.6;  ///< covered share that counts as a whole edge

/// A model edge in one image, its candidates and its match.
struct EdgeSearch {
  PredictedEdge predicted;
  std::vector<EdgeCandidate> candidates;
  EdgeMatch match;
  double nearest_px = 1e9;  ///< distance of the next model edge beside it

  bool EndIsInView(bool from) const { return from ? predicted.p_is_end : predicted.q_is_end; }
};

/// The visible edges of the model that the view may hold, nothing looked for yet.
std::vector<EdgeSearch> PredictSearches(const LandmarkModel& model, std::span<const int> visible,
                                        const CameraView& view, const Eigen::Isometry3d& base_from_landmark);

/// Drops edges that lie nearer to each other than the kernels of the edge operator are wide.
void DropCrowded(std::vector<EdgeSearch>& searches, double min_separation_px);

/// Makes the match of the candidates: of the contrast sign that is more likely.
void MatchCandidates(EdgeSearch& search, const LandmarkEdge& edge, const CameraView& view,
                     const AssociationOptions& options);

/// Leaves an image edge to one model edge only: the one it fits best.
void MakeExclusive(std::vector<EdgeSearch>& searches);

/// Similar edges per pixel beside the prediction that no model edge explains: the chance rate of a false
/// match.
double ClutterDensity(const EdgeSearch& search, const std::vector<EdgeSearch>& all, double window_px);

}  // namespace priamos::head
