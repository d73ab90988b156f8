#include "robot/core/pose/plan_match.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include "robot/core/pose/split_fusion.hpp"

namespace priamos::robot {
namespace {

constexpr double kSameFacing = Radians(12);
constexpr double kBeyondEnd_m = 0.5;  ///< so far beyond its end a wall may still be heard

/// A wall of the plan by its normal form about an anchor, minus the same of a wall of the state, and what the
/// plan may err in both [rad, m].
struct Comparison {
  Eigen::Vector2d residual{0, 0};
  Eigen::Matrix2d plan_covariance = Eigen::Matrix2d::Zero();
};

Comparison Compare(const WallLine& wall, const PlanWall& plan) {
  const Eigen::Vector2d along = plan.along(), normal = plan.normal();
  const double length_m = plan.length_m();
  // Foot of the anchor on the plan's wall, from 0 to 1; the ends err independently.
  const double foot = along.dot(wall.anchor - plan.from) / length_m;
  const Eigen::RowVector2d angle_by_ends(1 / length_m, -1 / length_m), distance_by_ends(1 - foot, foot);
  Eigen::Matrix2d by_ends;
  by_ends << angle_by_ends, distance_by_ends;
  Comparison comparison;
  comparison.residual << WrapAngle(std::atan2(normal.y(), normal.x()) - wall.angle_rad),
      normal.dot(plan.from - wall.anchor) - wall.distance_m;
  comparison.plan_covariance = plan.sigma_m * plan.sigma_m * by_ends * by_ends.transpose();
  return comparison;
}

Derivative<2> ByWall(const PoseState& state, int wall) {
  Derivative<2> h = Derivative<2>::Zero(2, state.size());
  h.block<2, 2>(0, PoseState::kOwn + 2 * wall).setIdentity();
  return h;
}

/// A wall of the state beside the wall of the plan that it may be; distances are from the base.
struct Candidate {
  PlanMatch match;
  Eigen::Vector2d normal{0, 0};
  double heard_m = 0, planned_m = 0, sigma_m = 0;
};

/// Mahalanobis distance of a wall of the state from one of the plan; infinite where it cannot be that one.
double DistanceFrom(const PoseState& state, int wall, const PlanWall& plan) {
  const WallLine line = WallOf(state, wall);
  const double foot_m = plan.along().dot(state.pose().translation() - plan.from);
  const Comparison comparison = Compare(line, plan);
  if (std::abs(comparison.residual(0)) > kSameFacing || foot_m < -kBeyondEnd_m ||
      foot_m > plan.length_m() + kBeyondEnd_m)
    return std::numeric_limits<double>::infinity();
  const Derivative<2> h = ByWall(state, wall);
  const Eigen::Matrix2d spread = h * state.covariance * h.transpose() + comparison.plan_covariance;
  return std::sqrt(comparison.residual.dot(spread.ldlt().solve(comparison.residual)));
}

/// How well the distance of a wall of the state from one of the plan can be foreseen beside the base.
double SigmaBeside(const PoseState& state, int wall, const PlanWall& plan) {
  const WallLine line = WallOf(state, wall);
  const Eigen::Vector2d normal = line.normal();
  const double ahead_m =
      Eigen::Vector2d(-normal.y(), normal.x()).dot(state.pose().translation() - line.anchor);
  const Eigen::RowVector2d beside(-ahead_m, 1);
  const Derivative<2> h = ByWall(state, wall);
  const Eigen::Matrix2d spread = h * state.covariance * h.transpose() + Compare(line, plan).plan_covariance;
  return std::sqrt((beside * spread * beside.transpose())(0));
}

std::optional<Candidate> CandidateFor(const PoseState& state, int wall, const std::vector<PlanWall>& plan,
                                      const PlanMatchConfig& config) {
  const PlanWall* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity(), second = least;
  for (const PlanWall& candidate : plan) {
    const double distance = DistanceFrom(state, wall, candidate);
    if (distance < least) {
      second = least;
      least = distance;
      nearest = &candidate;
    } else if (distance < second) {
      second = distance;
    }
  }
  if (!nearest || !(least <= config.gate_distance) || second <= config.apart_distance) return std::nullopt;
  const WallLine line = WallOf(state, wall);
  const Eigen::Vector2d base = state.pose().translation();
  return Candidate{{wall, *nearest},
                   line.normal(),
                   line.distance_m - line.normal().dot(base - line.anchor),
                   nearest->normal().dot(nearest->from - base),
                   SigmaBeside(state, wall, *nearest)};
}

/// Whether two walls are opposite each other, as far apart as on the plan.
bool Agree(const Candidate& a, const Candidate& b) {
  constexpr double kHeard_m = 0.02, kSigmas = 3;
  if (a.normal.dot(b.normal) > -std::cos(kSameFacing)) return false;
  const double sigma_m = std::hypot(a.match.plan.sigma_m, b.match.plan.sigma_m, kHeard_m);
  return std::abs(a.heard_m + b.heard_m - a.planned_m - b.planned_m) < kSigmas * sigma_m;
}

}  // namespace

void PlanMatchConfig::Describe(Archive& a) {
  a.Number("gate_distance", gate_distance,
           {"-", 0.5, 10, "Mahalanobis distance beyond which a wall is not that of the plan"});
  a.Number("apart_distance", apart_distance, {"-", 1, 20, "as far off every other wall of the plan is"});
  a.Number("alone_m", alone_m,
           {"m", 0.01, 1, "three sigmas of a wall's place; worse known, the wall opposite has to agree"});
  a.Number("every_s", every_s, {"s", 0.1, 60, "time between two comparisons with the plan"});
}

std::vector<PlanMatch> MatchPlan(const PoseState& state, const std::bitset<PoseState::kMostWalls>& heard,
                                 const std::vector<PlanWall>& plan, const PlanMatchConfig& config) {
  constexpr double kSigmas = 3;
  std::vector<Candidate> candidates;
  for (int wall = 0; wall < state.walls(); ++wall) {
    if (!heard[static_cast<std::size_t>(wall)]) continue;
    if (const auto candidate = CandidateFor(state, wall, plan, config)) candidates.push_back(*candidate);
  }
  std::vector<PlanMatch> matches;
  for (const Candidate& candidate : candidates) {
    bool sure = kSigmas * candidate.sigma_m < config.alone_m;
    for (const Candidate& other : candidates) sure = sure || Agree(candidate, other);
    if (sure) matches.push_back(candidate.match);
  }
  return matches;
}

PoseState Updated(const PoseState& prior, const PlanMatch& match) {
  const Comparison comparison = Compare(WallOf(prior, match.wall), match.plan);
  const Derivative<2> h = ByWall(prior, match.wall);
  const auto fusion = BestFusion<2>(prior, comparison.plan_covariance, 0, h);
  const Gain<2> gain = fusion.GainFor(h);
  PoseState state = prior;
  state.mean += gain * comparison.residual;
  state.mean(2) = WrapAngle(state.mean(2));
  const PoseState::Matrix own =
      Joseph<2>(gain, h, prior.covariance - prior.repeated, Eigen::Matrix2d::Zero());
  state.covariance = Joseph<2>(gain, h, fusion.prior, fusion.measurement);
  state.repeated = state.covariance - own;
  return state;
}

}  // namespace priamos::robot
