#include "head/core/doors/door_state.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

constexpr double kStep_m = 0.01, kStep_rad = Radians(2);
constexpr double kSeldomAjar = 1.5;  ///< log odds of a closed leaf against one that is a little open
constexpr double kDeep_m = 2;        ///< how far apart surfaces of a room are
/// Shares of the surfaces that are seen where a leaf is: pieces of it, what stands before it, what it should
/// hide.
constexpr double kOfLeaf = 0.87, kBefore = 0.1, kBehind = 0.03;

/// Surfaces so near to the sides, and no deeper, may be the reveal.
constexpr double kBeside_m = 0.13, kReveal_m = 0.3;

bool IsReveal(const SurfacePoint& surface, double half_m) {
  return std::abs(surface.at.y()) > half_m - kBeside_m && surface.at.x() < kReveal_m;
}

/// A leaf whose face meets the hinge at x = `depth_m`, y = `side` * `half_m`.
struct SupposedLeaf {
  double half_m, depth_m, open_rad;
  int side;

  /// Log likelihood of a surface if the leaf is there, less that in a room.
  double Of(const SurfacePoint& surface, double leaf_sigma_m) const {
    const double c = std::cos(open_rad), s = std::sin(open_rad);
    const double from_hinge = half_m - side * surface.at.y(), into = surface.at.x() - depth_m;
    const double along = c * from_hinge + s * into, off = c * into - s * from_hinge;
    const double elsewhere = off > 0 ? kBehind : kBefore;
    if (along < 0 || along > 2 * half_m) return std::log(elsewhere + kOfLeaf / 8);  // past its end
    const double sigma = std::hypot(leaf_sigma_m, surface.sigma_x_m);
    const double density = std::exp(-0.5 * off * off / (sigma * sigma)) / (sigma * std::sqrt(2 * kPi));
    return std::log(kOfLeaf * kDeep_m * density + elsewhere);
  }
};

double Of(const SupposedLeaf& leaf, std::span<const SurfacePoint> surfaces, double sigma_m) {
  double sum = 0;
  for (const SurfacePoint& surface : surfaces)
    if (!IsReveal(surface, leaf.half_m)) sum += leaf.Of(surface, sigma_m);
  return sum;
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
  double closed = -1e9, ajar = -1e9;
  for (double depth_m = -options.foremost_m; depth_m <= options.deepest_m; depth_m += kStep_m) {
    for (double open_rad = 0; open_rad < options.open_rad; open_rad += kStep_rad) {
      for (const int side : {-1, 1}) {
        const SupposedLeaf leaf{opening.width_m / 2, depth_m, open_rad, side};
        double& best = open_rad < options.ajar_rad ? closed : ajar;
        best = std::max(best, Of(leaf, surfaces, options.leaf_sigma_m));
      }
    }
  }
  DoorStateEvidence evidence;
  // What is beyond the most is taken from both: which of them it is stays as sure.
  const double beyond = std::max(0.0, options.each * std::max(closed, ajar) - options.most);
  const auto scaled = [&](double likelihood) {
    return std::max(options.each * likelihood - beyond, -options.most);
  };
  evidence.log_likelihood = {scaled(closed), scaled(ajar) - kSeldomAjar, 0};
  return evidence;
}

}  // namespace priamos::head
