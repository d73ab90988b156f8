#include "head/core/doors/door_state.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

constexpr double kStep_m = 0.01, kStep_rad = Radians(1);
constexpr double kPrior = 1;  ///< of "nothing to be seen", which closed leaves show more often than rooms do

/// How well surfaces agree with one leaf.
struct LeafVotes {
  int on = 0, behind = 0;

  /// Its log likelihood against a world without leaf.
  double Worth() const { return on - 1.5 * behind; }
};

/// The votes for a leaf whose face meets the hinge at x = `depth_m`, y = `side` * `half_m`.
LeafVotes VotesFor(std::span<const SurfacePoint> surfaces, double half_m, int side, double depth_m,
                   double open_rad, double on_leaf_m) {
  LeafVotes votes;
  const double c = std::cos(open_rad), s = std::sin(open_rad);
  for (const SurfacePoint& surface : surfaces) {
    const double from_hinge = half_m - side * surface.at.y(), into = surface.at.x() - depth_m;
    const double along = c * from_hinge + s * into, off = c * into - s * from_hinge;
    if (along < 0 || along > 2 * half_m) {
      votes.behind += into > 3 * on_leaf_m;
      continue;
    }
    const double tolerance = std::hypot(on_leaf_m, 2 * surface.sigma_x_m * c);
    votes.on += std::abs(off) < tolerance;
    votes.behind += off > 3 * tolerance;
  }
  return votes;
}

}  // namespace

void DoorStateEvidence::operator+=(const DoorStateEvidence& other) {
  for (std::size_t i = 0; i < log_likelihood.size(); ++i) log_likelihood[i] += other.log_likelihood[i];
}

DoorState DoorStateEvidence::State(double min_lead) const {
  if (Lead() < min_lead) return DoorState::kUnknown;
  const auto best = std::max_element(log_likelihood.begin(), log_likelihood.end());
  return static_cast<DoorState>(1 + (best - log_likelihood.begin()));
}

double DoorStateEvidence::Lead() const {
  auto sorted = log_likelihood;
  std::sort(sorted.begin(), sorted.end());
  return sorted[2] - sorted[1];
}

DoorStateEvidence StateOf(const OpeningShape& opening, std::span<const SurfacePoint> surfaces,
                          const DoorStateOptions& options) {
  const double half_m = opening.width_m / 2;
  double closed = -1e9, ajar = -1e9;
  for (double depth_m = -options.foremost_m; depth_m <= options.deepest_m; depth_m += kStep_m) {
    for (double open_rad = 0; open_rad < options.open_rad; open_rad += kStep_rad) {
      for (const int side : {-1, 1}) {
        const double worth =
            VotesFor(surfaces, half_m, side, depth_m, open_rad, options.on_leaf_m).Worth();
        double& best = open_rad < options.ajar_rad ? closed : ajar;
        best = std::max(best, worth);
      }
    }
  }
  DoorStateEvidence evidence;
  const auto scaled = [&](double worth) {
    return std::clamp(options.each * worth, -options.most, options.most);
  };
  evidence.log_likelihood = {scaled(closed) + kPrior, scaled(ajar), 0};
  return evidence;
}

}  // namespace priamos::head
