#include "planner/core/locate/place_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/principal_axes.hpp"
#include "planner/core/locate/place_grid.hpp"

namespace priamos::planner {
namespace {

constexpr double kYawStep_rad = 0.035;
/// What a cell is judged by is coarser than the place that the fit finds in it.
constexpr double kCoarse = 3;
/// A place whose walls hold it worse than this, or that goes on so far, is a stretch.
constexpr double kPoint_m = 0.4, kStretch_m = 1.5;
/// So many places are looked at closely for one drive; more tell that it says nothing yet.
constexpr std::size_t kMostPlaces = 40000;

struct Rough {
  Pose2 map_from_base;
  double bound = 0;  ///< what the walls are worth there
};

/// Every cell of every heading that may be no worse than the best by the margin.
std::vector<Rough> RoughPlaces(const PlaceSearchConfig& config, const PlacePlan& plan,
                               const PlaceScorer& scorer) {
  PlaceGrid grid(plan, scorer);
  std::vector<std::pair<double, double>> headings;  // bound, heading
  for (double yaw = -kPi; yaw < kPi; yaw += kYawStep_rad) headings.emplace_back(grid.Bound(yaw), yaw);
  std::stable_sort(headings.begin(), headings.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Rough> places;
  double best = 0;
  for (const auto& [bound, yaw] : headings) {
    if (bound < best - config.margin - kCoarse) break;
    grid.Fill(yaw);
    for (std::size_t cell = 0; cell < grid.size(); ++cell) {
      const double worth = grid.at(cell);
      if (worth <= 0) continue;
      const Eigen::Vector2d at = grid.PlaceOf(cell);
      if (plan.IsInWall(at)) continue;
      if (worth > best) best = std::max(best, worth + scorer.Penalty({at.x(), at.y(), yaw}));
      if (worth >= best - config.margin - kCoarse) places.push_back({{at.x(), at.y(), yaw}, worth});
    }
  }
  std::erase_if(places, [&](const Rough& p) { return p.bound < best - config.margin - kCoarse; });
  std::stable_sort(places.begin(), places.end(),
                   [](const Rough& a, const Rough& b) { return a.bound > b.bound; });
  return places;
}

bool AreNear(const PlaceSearchConfig& config, const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() <= config.same_m &&
         std::abs(WrapAngle(a.yaw - b.yaw)) <= Radians(config.same_deg);
}

/// The fits that are good enough, best first.
std::vector<PlaceFit> FitsOf(const PlaceSearchConfig& config, const PlaceScorer& scorer,
                             std::vector<Rough> places) {
  std::vector<PlaceFit> fits;
  double best = 0;
  for (const Rough& place : places) {
    if (place.bound < best - config.margin - kCoarse) break;
    if (fits.size() >= kMostPlaces) return {};
    const PlaceFit fit = scorer.Refined(place.map_from_base);
    best = std::max(best, fit.score);
    fits.push_back(fit);
  }
  if (best < config.margin) return {};
  std::erase_if(fits, [&](const PlaceFit& fit) { return fit.score < best - config.margin; });
  std::stable_sort(fits.begin(), fits.end(),
                   [](const PlaceFit& a, const PlaceFit& b) { return a.score > b.score; });
  return fits;
}

Eigen::Matrix3d CovarianceOf(const PlaceFit& fit) {
  constexpr double kUnknown_m = 5, kUnknown_rad = 0.5;
  Eigen::Matrix3d information = fit.information;
  information.diagonal() += Eigen::Vector3d(kUnknown_m, kUnknown_m, kUnknown_rad).cwiseAbs2().cwiseInverse();
  return information.inverse();
}

/// Fits that hang together, from one to the next, are one candidate.
std::vector<PlaceCandidate> Grouped(const PlaceSearchConfig& config, const std::vector<PlaceFit>& fits) {
  std::vector<PlaceCandidate> candidates;
  std::vector<bool> taken(fits.size(), false);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (taken[i]) continue;
    taken[i] = true;
    std::vector<std::size_t> group{i};
    PlaceCandidate candidate{fits[i].map_from_base, CovarianceOf(fits[i]), fits[i].score, fits[i].matched, 0};
    for (std::size_t next = 0; next < group.size(); ++next)
      for (std::size_t k = i + 1; k < fits.size(); ++k) {
        if (taken[k] || !AreNear(config, fits[group[next]].map_from_base, fits[k].map_from_base)) continue;
        taken[k] = true;
        group.push_back(k);
        candidate.spread_m =
            std::max(candidate.spread_m,
                     (fits[k].map_from_base.translation() - candidate.map_from_base.translation()).norm());
      }
    candidates.push_back(candidate);
  }
  return candidates;
}

/// Many fits end at one place: one of each is enough.
std::vector<PlaceFit> Thinned(const std::vector<PlaceFit>& fits) {
  constexpr double kApart_m = 0.08, kApart_rad = 0.03;
  std::vector<PlaceFit> kept;
  for (const PlaceFit& fit : fits) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const PlaceFit& other) {
      return std::abs(other.map_from_base.x - fit.map_from_base.x) < kApart_m &&
             std::abs(other.map_from_base.y - fit.map_from_base.y) < kApart_m &&
             std::abs(WrapAngle(other.map_from_base.yaw - fit.map_from_base.yaw)) < kApart_rad;
    });
    if (!known) kept.push_back(fit);
  }
  return kept;
}

}  // namespace

void PlaceSearchConfig::Describe(Archive& a) {
  a.Number("margin", margin, {"-", 1, 50, "log-likelihood by which a place is out against the best"});
  a.Number("same_m", same_m, {"m", 0.1, 5, "places no farther apart are one"});
  a.Number("same_deg", same_deg, {"deg", 1, 90, "nor turned more"});
  a.Section("score", score, "what each finding is worth");
}

bool PlaceCandidate::IsHeld() const {
  return PositionSigma(covariance) <= kPoint_m;
}

bool PlaceCandidate::IsPoint() const {
  return spread_m <= kStretch_m && IsHeld();
}

std::vector<PlaceCandidate> FindPlaces(const PlaceSearchConfig& config, const PlacePlan& plan,
                                       const DrivenWay& way) {
  if (way.trail.empty() || way.pieces.empty() || plan.faces().empty()) return {};
  const PlaceScorer scorer(config.score, plan, way);
  std::vector<Rough> places = RoughPlaces(config, plan, scorer);
  return Grouped(config, Thinned(FitsOf(config, scorer, std::move(places))));
}

}  // namespace priamos::planner
