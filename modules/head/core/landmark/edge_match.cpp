#include "head/core/landmark/edge_match.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

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

bool WithinGate(const EdgeCandidate& c, bool sign, const AssociationOptions& options) {
  return c.same_sign == sign && std::abs(c.distance) <= options.gate_px;
}

/// The long candidate near the prediction that decides where the edge is; nullptr if there is none.
const EdgeCandidate* Decisive(const std::vector<EdgeCandidate>& candidates, bool sign,
                              const AssociationOptions& options) {
  const EdgeCandidate* best = nullptr;
  double best_value = 0;
  for (const EdgeCandidate& c : candidates) {
    if (!WithinGate(c, sign, options)) continue;
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
  const EdgeCandidate* best = Decisive(candidates, sign, options);
  if (!best) return match;
  std::vector<std::pair<double, double>> parts;
  double sum = 0, weight = 0, ratio = 0, before = 0, after = 0, first = length, last = 0;
  for (const EdgeCandidate& c : candidates) {
    if (!WithinGate(c, sign, options)) continue;
    // Others must continue the decisive one, not lie beside it.
    if (std::abs(c.distance - best->distance) > 2 * options.sigma_px) continue;
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
  match.is_end_in_view = {predicted.p_is_end, predicted.q_is_end};
  match.distance_px = sum / weight;
  match.grey_ratio = ratio / weight;
  match.predicted_px = length;
  return match;
}

}  // namespace

EdgeMatch MatchEdge(const std::vector<EdgeCandidate>& candidates, const PredictedEdge& predicted,
                    const LandmarkEdge& edge, const CameraView& view, const AssociationOptions& options) {
  EdgeMatch match = Collect(candidates, true, predicted, view, options);
  EdgeMatch other = Collect(candidates, false, predicted, view, options);
  const auto worth = [&](const EdgeMatch& m) {
    return m.covered * std::exp(GreyOdds(edge, m.grey_ratio, options) - std::abs(m.distance_px));
  };
  return worth(other) > worth(match) ? other : match;
}

}  // namespace priamos::head
