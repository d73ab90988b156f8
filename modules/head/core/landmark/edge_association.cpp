#include "head/core/landmark/edge_association.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "head/core/landmark/edge_candidates.hpp"
#include "head/core/landmark/landmark_corners.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kUsualCandidates = 16;
constexpr int kSides = 4;                  ///< values of LandmarkEdge::side
constexpr double kMinDensity = 0.01;       ///< similar edges per pixel: even a bare wall may hide one
constexpr double kOvershootPenalty = 0.5;  ///< log odds lost per pixel beyond
constexpr double kNearlyWhole = 0.6;       ///< covered share that counts as a whole edge

/// A model edge in one image, its candidates and its match.
struct Search {
  PredictedEdge predicted;
  std::vector<EdgeCandidate> candidates;
  EdgeMatch match;
  double nearest_px = 1e9;  ///< distance of the next model edge beside it

  bool EndIsInView(bool from) const { return from ? predicted.p_is_end : predicted.q_is_end; }
};

std::vector<Search> Predict(const LandmarkModel& model, std::span<const int> visible, const CameraView& view,
                            const Eigen::Isometry3d& base_from_landmark) {
  std::vector<Search> searches;
  searches.reserve(visible.size());
  for (const int index : visible) {
    const LandmarkEdge& edge = model.edges[index];
    const auto predicted =
        ProjectEdge(*view.camera, view.size, base_from_landmark * edge.from, base_from_landmark * edge.to);
    if (!predicted) continue;
    searches.push_back({{*predicted, index}, {}, {}, 1e9});
    searches.back().candidates.reserve(kUsualCandidates);
  }
  return searches;
}

/// How far beside `a` the edge `b` runs, if they run beside each other.
double Separation(const ProjectedEdge& a, const ProjectedEdge& b) {
  const Eigen::Vector2d direction = a.direction(), normal = a.normal();
  if (std::abs(normal.dot(b.direction())) > 0.1) return 1e9;
  double s = direction.dot(b.p - a.p), t = direction.dot(b.q - a.p);
  if (s > t) std::swap(s, t);
  if (std::min(t, a.length_px()) - std::max(s, 0.0) < 0.2 * a.length_px()) return 1e9;
  return std::abs(normal.dot((b.p + b.q) / 2 - a.p));
}

/// Drops edges that lie nearer to each other than the kernels of the edge operator are wide.
void DropCrowded(std::vector<Search>& searches, double min_separation_px) {
  for (Search& a : searches) {
    for (const Search& b : searches) {
      if (&a != &b) a.nearest_px = std::min(a.nearest_px, Separation(a.predicted, b.predicted));
    }
  }
  std::erase_if(searches, [&](const Search& s) { return s.nearest_px < min_separation_px; });
}

/// An image edge belongs to one model edge only: the one it fits best.
void MakeExclusive(std::vector<Search>& searches) {
  for (Search& a : searches) {
    for (Search& b : searches) {
      if (&a == &b) continue;
      const bool shared = std::any_of(a.match.lines.begin(), a.match.lines.end(), [&](int line) {
        return std::find(b.match.lines.begin(), b.match.lines.end(), line) != b.match.lines.end();
      });
      if (!shared) continue;
      const auto worth = [](const EdgeMatch& m) { return m.covered * std::exp(-std::abs(m.distance_px)); };
      (worth(a.match) < worth(b.match) ? a : b).match = EdgeMatch{};
    }
  }
}

/// Similar edges per pixel beside the prediction that no model edge explains: the chance rate of a false
/// match.
double Density(const Search& search, const std::vector<Search>& all, double window_px) {
  const double length = search.predicted.length_px();
  double n = 0;
  for (const EdgeCandidate& c : search.candidates) {
    const bool explained = std::any_of(all.begin(), all.end(), [&](const Search& s) {
      return std::find(s.match.lines.begin(), s.match.lines.end(), c.line) != s.match.lines.end();
    });
    if (!explained) n += std::min(1.0, (c.to - c.from) / (kNearlyWhole * length));
  }
  return std::max(kMinDensity, n / (2 * window_px));
}

void Account(const Search& search, const LandmarkEdge& edge, double density, int camera,
             const AssociationOptions& options, Association& association) {
  const EdgeMatch& match = search.match;
  const double importance = std::min(1.0, search.predicted.length_px() / kFullLength_px);
  const int side = std::clamp(edge.side, 0, kSides - 1);
  Odds odds = EdgeOdds(match.distance_px, density, options);
  odds.found += GreyOdds(edge, match.grey_ratio, options);
  odds.found =
      std::max(odds.missed, odds.found - kOvershootPenalty *
                                             std::max(0.0, match.overshoot_px - options.free_overshoot_px));
  ++association.n_predicted;
  association.side_predicted_px[side] += importance * kFullLength_px;
  association.best_log_odds += importance * (EdgeOdds(0, density, options).found +
                                             GreyOdds(edge, edge.grey_ratio.value_or(0), options));
  if (match.covered < options.min_covered) {
    association.log_odds += importance * odds.missed;
    return;
  }
  const double part = std::min(1.0, match.covered / kNearlyWhole);
  const double log_odds = importance * (part * odds.found + (1 - part) * odds.missed);
  association.log_odds += log_odds;
  association.side_found_px[side] += importance * kFullLength_px * part * (odds.found > 0 ? 1 : 0);
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
void AccountCorners(const std::vector<Search>& searches, const LandmarkModel& model, int camera,
                    const AssociationOptions& options, Association& all, Association& movable) {
  for (std::size_t i = 0; i < searches.size(); ++i) {
    for (std::size_t j = i + 1; j < searches.size(); ++j) {
      const Search &s = searches[i], &t = searches[j];
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
    std::vector<Search> searches = Predict(model, visible, views[c], base_from_landmark);
    DropCrowded(searches, options.min_separation_px);
    CandidateSearch near(views[c], options.clutter_window_px, options.max_angle_rad);
    for (Search& search : searches) {
      near.Find(search.predicted, search.candidates);
      search.match = MatchEdge(search.candidates, search.predicted, model.edges[search.predicted.edge],
                               views[c], options);
    }
    MakeExclusive(searches);
    for (const Search& search : searches) {
      const double density = Density(search, searches, options.clutter_window_px);
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
    const double importance = std::min(1.0, m.predicted_px / kFullLength_px);
    log_odds += importance * missed_log_odds - m.log_odds;
    side_found_px[side] -= importance * kFullLength_px * std::min(1.0, m.covered / kNearlyWhole);
  }
  side_found_px[side] = std::max(0.0, side_found_px[side]);
  std::erase_if(matches, is_it);
  std::erase_if(corners, [&](const CornerMatch& c) {
    const bool gone = (c.a == edge || c.b == edge) && (camera < 0 || c.camera == camera);
    if (gone) log_odds -= c.log_odds;
    return gone;
  });
}

void Association::SetAside(int edge, int camera) {
  for (EdgeMatch& m : matches)
    if (m.edge == edge && (camera < 0 || m.camera == camera)) m.is_measured = false;
}

int Association::Measuring() const {
  return static_cast<int>(
      std::count_if(matches.begin(), matches.end(), [](const EdgeMatch& m) { return m.is_measured; }));
}

}  // namespace priamos::head
