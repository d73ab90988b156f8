#include "head/core/landmark/edge_search.hpp"

#include <algorithm>
#include <cmath>

#include "head/core/landmark/edge_odds.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kUsualCandidates = 16;
constexpr double kMinDensity = 0.01;  ///< similar edges per pixel: even a bare wall may hide one

double Union(std::vector<std::pair<double, double>>& parts) {
  std::sort(parts.begin(), parts.end());
  double covered = 0, end = -1e9;
  for (const auto& [from, to] : parts) {
    covered += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return covered;
}

/// EdgeMatch::grey_ratio of a candidate: its sign follows the direction of the prediction.
double GreyRatio(const CameraView& view, const EdgeCandidate& c) {
  constexpr double kBlack = 4;  // darker than that a ratio means nothing
  const EdgeSegment& segment = view.edges->segments[view.lines[c.line].segment];
  const double ratio = std::log(std::max(segment.grey_right, kBlack) / std::max(segment.grey_left, kBlack));
  return c.same_sign ? ratio : -ratio;
}

/// Whether a candidate has the contrast sign and lies within the gate.
bool IsNear(const EdgeCandidate& c, bool sign, const AssociationOptions& options) {
  return c.same_sign == sign && !(std::abs(c.distance) > options.gate_px);
}

/// The nearest long candidate, which decides where the edge is; nullptr if none is near.
const EdgeCandidate* Leader(const std::vector<EdgeCandidate>& candidates, bool sign,
                            const AssociationOptions& options) {
  const EdgeCandidate* best = nullptr;
  double best_value = 0;
  for (const EdgeCandidate& c : candidates) {
    if (!IsNear(c, sign, options)) continue;
    const double value =
        (c.to - c.from) * std::exp(-0.5 * c.distance * c.distance / (options.sigma_px * options.sigma_px));
    if (value > best_value) {
      best = &c;
      best_value = value;
    }
  }
  return best;
}

/// The candidates of one contrast sign within the gate, as one match.
EdgeMatch Collect(const std::vector<EdgeCandidate>& candidates, bool sign, const PredictedEdge& predicted,
                  const CameraView& view, const AssociationOptions& options) {
  const double length = predicted.length_px();
  EdgeMatch match;
  const EdgeCandidate* best = Leader(candidates, sign, options);
  if (!best) return match;
  std::vector<std::pair<double, double>> parts;
  double sum = 0, weight = 0, ratio = 0, before = 0, after = 0, first = length, last = 0;
  for (const EdgeCandidate& c : candidates) {
    // The others must continue it, not lie beside it.
    if (!IsNear(c, sign, options) || std::abs(c.distance - best->distance) > 2 * options.sigma_px) continue;
    match.lines.push_back(c.line);
    parts.emplace_back(c.from, c.to);
    sum += c.distance * (c.to - c.from);
    weight += c.to - c.from;
    ratio += GreyRatio(view, c) * (c.to - c.from);
    before = std::max(before, c.before);
    after = std::max(after, c.after);
    first = std::min(first, c.from);
    last = std::max(last, c.to);
  }
  match.overshoot_px = (predicted.p_is_end ? before : 0) + (predicted.q_is_end ? after : 0);
  match.covered = std::min(1.0, Union(parts) / length);
  match.gap_px = {before > 0 ? -before : first, after > 0 ? -after : length - last};
  match.distance_px = sum / weight;
  match.grey_ratio = ratio / weight;
  match.predicted_px = length;
  return match;
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

}  // namespace

std::vector<EdgeSearch> PredictSearches(const LandmarkModel& model, std::span<const int> visible,
                                        const CameraView& view, const Eigen::Isometry3d& base_from_landmark) {
  std::vector<EdgeSearch> searches;
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

void DropCrowded(std::vector<EdgeSearch>& searches, double min_separation_px) {
  for (EdgeSearch& a : searches) {
    for (const EdgeSearch& b : searches) {
      if (&a != &b) a.nearest_px = std::min(a.nearest_px, Separation(a.predicted, b.predicted));
    }
  }
  std::erase_if(searches, [&](const EdgeSearch& s) { return s.nearest_px < min_separation_px; });
}

void MatchCandidates(EdgeSearch& search, const LandmarkEdge& edge, const CameraView& view,
                     const AssociationOptions& options) {
  search.match = Collect(search.candidates, true, search.predicted, view, options);
  EdgeMatch other = Collect(search.candidates, false, search.predicted, view, options);
  const auto worth = [&](const EdgeMatch& m) {
    return m.covered * std::exp(GreyOdds(edge, m.grey_ratio, options) - std::abs(m.distance_px));
  };
  if (worth(other) > worth(search.match)) search.match = std::move(other);
}

void MakeExclusive(std::vector<EdgeSearch>& searches) {
  for (EdgeSearch& a : searches) {
    for (EdgeSearch& b : searches) {
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

double ClutterDensity(const EdgeSearch& search, const std::vector<EdgeSearch>& all, double window_px) {
  const double length = search.predicted.length_px();
  double n = 0;
  for (const EdgeCandidate& c : search.candidates) {
    const bool explained = std::any_of(all.begin(), all.end(), [&](const EdgeSearch& s) {
      return std::find(s.match.lines.begin(), s.match.lines.end(), c.line) != s.match.lines.end();
    });
    if (!explained) n += std::min(1.0, (c.to - c.from) / (kNearlyWhole * length));
  }
  return std::max(kMinDensity, n / (2 * window_px));
}

}  // namespace priamos::head
