#include "head/core/landmark/edge_association.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "head/core/landmark/edge_odds.hpp"
#include "head/core/landmark/edge_search.hpp"
#include "head/core/landmark/landmark_corners.hpp"

namespace priamos::head {
namespace {

constexpr int kSides = 4;                  ///< values of LandmarkEdge::side
constexpr double kFullLengthPx = 40;       ///< shorter predictions count less
constexpr double kFreeOvershootPx = 6;     ///< ends are not found better than that
constexpr double kOvershootPenalty = 0.2;  ///< log odds lost per pixel beyond

void Account(const EdgeSearch& search, const LandmarkEdge& edge, double density, int camera,
             const AssociationOptions& options, Association& association) {
  const EdgeMatch& match = search.match;
  const double importance = std::min(1.0, search.predicted.length_px() / kFullLengthPx);
  const int side = std::clamp(edge.side, 0, kSides - 1);
  Odds odds = EdgeOdds(match.distance_px, density, options);
  odds.found += GreyOdds(edge, match.grey_ratio, options);
  odds.found = std::max(
      odds.missed, odds.found - kOvershootPenalty * std::max(0.0, match.overshoot_px - kFreeOvershootPx));
  ++association.n_predicted;
  association.side_predicted_px[side] += importance * kFullLengthPx;
  association.best_log_odds += importance * (EdgeOdds(0, density, options).found +
                                             GreyOdds(edge, edge.grey_ratio.value_or(0), options));
  if (match.covered < options.min_covered) {
    association.log_odds += importance * odds.missed;
    return;
  }
  const double part = std::min(1.0, match.covered / kNearlyWhole);
  const double log_odds = importance * (part * odds.found + (1 - part) * odds.missed);
  association.log_odds += log_odds;
  association.side_found_px[side] += importance * kFullLengthPx * part * (odds.found > 0 ? 1 : 0);
  association.matches.push_back(match);
  association.matches.back().edge = search.predicted.edge;
  association.matches.back().camera = camera;
  association.matches.back().log_odds = log_odds;
}

/// Adds the evidence of the movable part if it was found.
void JoinMovable(Association&& part, Association& all) {
  if (part.log_odds <= 0) return;
  const auto or_elsewhere = [](double log_odds) { return std::log1p(std::exp(log_odds)) + std::log(0.5); };
  all.n_predicted += part.n_predicted;
  all.log_odds += or_elsewhere(part.log_odds);
  all.best_log_odds += or_elsewhere(part.best_log_odds);
  for (std::size_t i = 0; i < all.side_found_px.size(); ++i) {
    all.side_predicted_px[i] += part.side_predicted_px[i];
    all.side_found_px[i] += part.side_found_px[i];
  }
  std::move(part.matches.begin(), part.matches.end(), std::back_inserter(all.matches));
  std::move(part.corners.begin(), part.corners.end(), std::back_inserter(all.corners));
}

/// Where two matched edges of the model meet, the image edges should end, too: edges that merely lie beside
/// the right ones do not know where those end. At a corner the operator sees little, so "there" is some
/// pixels wide.
void AccountCorners(const std::vector<EdgeSearch>& searches, const LandmarkModel& model, int camera,
                    const AssociationOptions& options, Association& all, Association& movable) {
  for (std::size_t i = 0; i < searches.size(); ++i) {
    for (std::size_t j = i + 1; j < searches.size(); ++j) {
      const EdgeSearch &s = searches[i], &t = searches[j];
      if (std::min(s.match.covered, t.match.covered) < options.min_covered) continue;
      const LandmarkEdge &a = model.edges[s.predicted.edge], &b = model.edges[t.predicted.edge];
      if (a.IsMovable() != b.IsMovable()) continue;
      const auto meeting = MeetingOf(a, b);
      if (!meeting || !s.EndIsInView(meeting->a_at_from) || !t.EndIsInView(meeting->b_at_from)) continue;
      const double gap = std::max(std::abs(s.match.gap_px[!meeting->a_at_from]),
                                  std::abs(t.match.gap_px[!meeting->b_at_from]));
      const Odds odds = CornerOdds(options);
      Association& association = a.IsMovable() ? movable : all;
      const double log_odds = gap <= options.corner_px ? odds.found : odds.missed;
      association.corners.push_back({s.predicted.edge, t.predicted.edge, camera, log_odds});
      association.log_odds += log_odds;
      association.best_log_odds += std::max(0.0, log_odds);
    }
  }
}

}  // namespace

Association Associate(const LandmarkModel& model, std::span<const int> visible,
                      std::span<const CameraView> views, const Eigen::Isometry3d& base_from_landmark,
                      const AssociationOptions& options) {
  Association association, movable;
  association.missed_log_odds = std::log(1 - options.detection);
  for (std::size_t c = 0; c < views.size(); ++c) {
    std::vector<EdgeSearch> searches = PredictSearches(model, visible, views[c], base_from_landmark);
    DropCrowded(searches, options.min_separation_px);
    CandidateSearch near(views[c], options.clutter_window_px, options.max_angle_rad);
    for (EdgeSearch& search : searches) {
      near.Find(search.predicted, search.candidates);
      MatchCandidates(search, model.edges[search.predicted.edge], views[c], options);
    }
    MakeExclusive(searches);
    for (const EdgeSearch& search : searches) {
      const double density = ClutterDensity(search, searches, options.clutter_window_px);
      const LandmarkEdge& edge = model.edges[search.predicted.edge];
      Account(search, edge, density, static_cast<int>(c), options, edge.IsMovable() ? movable : association);
    }
    AccountCorners(searches, model, static_cast<int>(c), options, association, movable);
  }
  JoinMovable(std::move(movable), association);
  return association;
}

void Association::Withdraw(const LandmarkModel& model, int edge, int camera) {
  const auto is_it = [&](const EdgeMatch& m) { return m.edge == edge && (camera < 0 || m.camera == camera); };
  const int side = std::clamp(model.edges[edge].side, 0, kSides - 1);
  for (const EdgeMatch& m : matches) {
    if (!is_it(m)) continue;
    const double importance = std::min(1.0, m.predicted_px / kFullLengthPx);
    log_odds += importance * missed_log_odds - m.log_odds;
    side_found_px[side] -= importance * kFullLengthPx * std::min(1.0, m.covered / kNearlyWhole);
  }
  side_found_px[side] = std::max(0.0, side_found_px[side]);
  std::erase_if(matches, is_it);
  std::erase_if(corners, [&](const CornerMatch& c) {
    const bool gone = (c.a == edge || c.b == edge) && (camera < 0 || c.camera == camera);
    if (gone) log_odds -= c.log_odds;
    return gone;
  });
}

}  // namespace priamos::head
