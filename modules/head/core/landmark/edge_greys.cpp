#include "head/core/landmark/edge_greys.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

/// The mean over all cameras, longer matches count more; nullopt where there is none, or cameras disagree.
std::optional<double> MeasuredRatio(int edge, std::span<const EdgeMatch> matches, double max_disagreement) {
  double sum = 0, weight = 0, least = 1e9, largest = -1e9;
  for (const EdgeMatch& match : matches) {
    if (match.edge != edge) continue;
    const double length_px = match.covered * match.predicted_px;
    sum += length_px * match.grey_ratio;
    weight += length_px;
    least = std::min(least, match.grey_ratio);
    largest = std::max(largest, match.grey_ratio);
  }
  if (weight <= 0 || largest - least > max_disagreement) return std::nullopt;
  return sum / weight;
}

EdgeGrey Follow(const std::optional<EdgeGrey>& known, double measured, const EdgeGreyOptions& options) {
  const EdgeGrey anew{measured, options.first_sigma};
  if (!known) return anew;
  const double surprise = measured - known->ratio;
  if (std::abs(surprise) > options.contradiction * known->sigma) return anew;
  const double variance =
      known->sigma * known->sigma * (1 - options.weight) + surprise * surprise * options.weight;
  return {known->ratio + options.weight * surprise, std::max(options.least_sigma, std::sqrt(variance))};
}

}  // namespace

EdgeGreys Learned(EdgeGreys known, const LandmarkModel& model, std::span<const EdgeMatch> matches,
                  const EdgeGreyOptions& options) {
  if (known.size() != model.edges.size()) known.assign(model.edges.size(), std::nullopt);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (model.edges[i].IsMovable()) continue;
    const auto measured = MeasuredRatio(static_cast<int>(i), matches, options.max_disagreement);
    if (measured) known[i] = Follow(known[i], *measured, options);
  }
  return known;
}

LandmarkModel WithGreys(LandmarkModel model, const EdgeGreys& known) {
  if (known.size() != model.edges.size()) return model;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!known[i]) continue;
    model.edges[i].grey_ratio = known[i]->ratio;
    model.edges[i].grey_sigma = known[i]->sigma;
  }
  return model;
}

}  // namespace priamos::head
