#include "head/core/landmark/edge_odds.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {

Odds EdgeOdds(double distance, double density, const AssociationOptions& options) {
  const double gauss = std::exp(-0.5 * distance * distance / (options.sigma_px * options.sigma_px)) /
                       (options.sigma_px * std::sqrt(2 * kPi));
  const double missed = std::log(1 - options.detection);
  return {std::max(missed, std::log(options.detection * gauss / density + (1 - options.detection))), missed};
}

double GreyOdds(const LandmarkEdge& edge, double measured, const AssociationOptions& options) {
  if (!edge.grey_ratio) return 0;
  const auto gauss = [](double x, double sigma) { return std::exp(-0.5 * x * x / (sigma * sigma)) / sigma; };
  const double sigma = edge.grey_sigma > 0 ? edge.grey_sigma : options.grey_sigma;
  const double modelled = gauss(measured - *edge.grey_ratio, sigma);
  const double any = gauss(measured, options.any_grey_sigma);
  return std::log((1 - options.grey_surprise) * modelled / any + options.grey_surprise);
}

Odds CornerOdds(const AssociationOptions& options) {
  return {std::log(options.corner_detection / options.corner_chance),
          std::log((1 - options.corner_detection) / (1 - options.corner_chance))};
}

}  // namespace priamos::head
