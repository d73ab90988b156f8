#include "planner/core/missions/leaf_belief.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

constexpr double kGate = 3;                  ///< sightings of one leaf differ by less, in sigmas ...
constexpr double kBesides_rad = Radians(1);  ///< ... and this
constexpr int kLeastLooks = 2;
constexpr double kLeastLogOdds = 6;
constexpr double kUnseenLogOdds = 1;  ///< of a look that shows no leaf, against there being one to see

bool Agree(const LeafSighting& a, const LeafSighting& b) {
  return a.hinge == b.hinge &&
         std::abs(a.open_rad - b.open_rad) < kGate * std::hypot(a.sigma_rad, b.sigma_rad) + kBesides_rad;
}

/// What agrees with one sighting.
struct Group {
  int n = 0;
  double log_odds = 0, weight = 0, sum_rad = 0, sigma_rad = 1;
};

Group Around(const LeafSighting& anchor, const std::vector<LeafSighting>& all) {
  Group group;
  for (const LeafSighting& s : all) {
    if (s.hinge.empty()) {
      group.log_odds -= kUnseenLogOdds;
    } else if (!Agree(s, anchor)) {
      group.log_odds -= s.log_odds;
    } else {
      const double weight = 1 / std::max(s.sigma_rad * s.sigma_rad, 1e-6);
      ++group.n;
      group.log_odds += s.log_odds;
      group.weight += weight;
      group.sum_rad += weight * s.open_rad;
      // Most of the error is that of the hinges, which all looks share.
      group.sigma_rad = std::min(group.sigma_rad, s.sigma_rad);
    }
  }
  return group;
}

}  // namespace

std::optional<LeafEstimate> LeafBelief::Estimate() const {
  std::optional<LeafEstimate> best;
  double log_odds = kLeastLogOdds;
  for (const LeafSighting& anchor : sightings_) {
    if (anchor.hinge.empty()) continue;
    const Group group = Around(anchor, sightings_);
    if (group.n < kLeastLooks || group.log_odds < log_odds) continue;
    log_odds = group.log_odds;
    best = LeafEstimate{anchor.hinge, group.sum_rad / group.weight, group.sigma_rad};
  }
  return best;
}

}  // namespace priamos::planner
