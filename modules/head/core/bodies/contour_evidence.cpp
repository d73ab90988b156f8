#include "head/core/bodies/contour_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "common/square.hpp"
#include "head/core/bodies/contour_pieces.hpp"
#include "head/core/landmark/edge_association.hpp"

namespace priamos::head {
namespace {

constexpr double kShortestEdge_px = 6;
constexpr double kThere_px = 1.2;   ///< so near to the prediction a step is the one predicted
constexpr double kBlank = 6;        ///< contrast of what is not there [grey values]
constexpr double kSeenShare = 0.4;  ///< share of an edge that must be seen for it to be seen
/// Weights of what the contour shows beside BodyAgreement::Value, which is 1.
constexpr double kSeenWeight = 1.47, kEdgesWeight = 0.68, kBesideWeight = 0.60;

/// Weights of ContourEvidence::LogOdds: a logistic regression, the density of the prior as it is.
constexpr double kOdds = -16.92, kOddsOfCovered = 7.52, kOddsOfEnds = 6.53, kOddsOfSeen = 4.20,
                 kOddsOfEdges = 6.53, kOddsOfBeside = 13.51;

/// Lengths of one edge, by what is there.
struct EdgeLengths {
  double seen = 0, blank = 0, other = 0, squares = 0;

  double all() const { return seen + blank + other; }
  void Add(const ContourPiece& piece) {
    const bool is_there = piece.IsStep() && std::abs(piece.step.shift_px) < kThere_px;
    (is_there ? seen : piece.step.steepest < kBlank ? blank : other) += piece.length_px;
    if (is_there) squares += piece.length_px * Square(piece.step.shift_px);
  }
};

/// Adds an edge, long ones as if they were shorter.
void Add(const EdgeLengths& edge, ContourEvidence& sum) {
  const double weight = std::min(kFullLength_px, edge.all()) / edge.all();
  sum.seen += weight * edge.seen;
  sum.blank += weight * edge.blank;
  sum.other += weight * edge.other;
  sum.rms_px += weight * edge.squares;
  ++sum.n_edges;
  sum.n_seen += edge.seen > kSeenShare * edge.all();
}

}  // namespace

double ContourEvidence::Shown() const {
  return kSeenWeight * seen + kEdgesWeight * std::log(std::max(1, n_seen)) - kBesideWeight * rms_px;
}

double ContourEvidence::LogOdds(const BodyAgreement& linked, double prior_sigmas) const {
  return kOdds + kOddsOfCovered * linked.covered + kOddsOfEnds * linked.ends + kOddsOfSeen * seen +
         kOddsOfEdges * std::log(std::max(1, n_seen)) - kOddsOfBeside * rms_px - Square(prior_sigmas) / 2;
}

ContourEvidence EvidenceOf(const LandmarkModel& seen, const Eigen::Isometry3d& base_from_model,
                           std::span<const CameraView> views, std::span<const StepMeter> meters) {
  ContourEvidence evidence;  // sums of lengths first
  for (std::size_t v = 0; v < views.size(); ++v) {
    const ContourPieces contour(seen, base_from_model, views[v]);
    for (std::size_t i = 0; i < contour.edges().size(); ++i) {
      if (!contour.edges()[i] || contour.edges()[i]->length_px() < kShortestEdge_px) continue;
      EdgeLengths lengths;
      for (const ContourPiece& piece : contour.Measure(meters[v], i, 0)) lengths.Add(piece);
      if (lengths.all() > 0) Add(lengths, evidence);
    }
  }
  const double all = evidence.seen + evidence.blank + evidence.other;
  evidence.rms_px = evidence.seen > 0 ? std::sqrt(evidence.rms_px / evidence.seen) : 0;
  for (double* share : {&evidence.seen, &evidence.blank, &evidence.other}) *share /= std::max(all, 1.0);
  return evidence;
}

}  // namespace priamos::head
