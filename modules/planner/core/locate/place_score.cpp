#include "planner/core/locate/place_score.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

constexpr double kGate = 3;            ///< sigmas
constexpr double kLongest_m = 4;       ///< more length does not make a piece surer to be a wall
constexpr double kMostPenalty = 24;    ///< of each kind: beyond it the plan may be what is wrong
constexpr double kBeforeWall_m = 0.3;  ///< sound is not followed into the wall that sent it back
/// A place does not move farther in the fit.
constexpr double kHold_m = 0.15, kHold_rad = 0.05;

Eigen::Vector2d LeftOf(const Eigen::Vector2d& along) {
  return {-along.y(), along.x()};
}

}  // namespace

void PlaceScoreConfig::Describe(Archive& a) {
  a.Number("across_m", across_m, {"m", 0.005, 0.5, "standard deviation of a heard wall across it"});
  a.Number("turned_deg", turned_deg, {"deg", 0.1, 10, "standard deviation of its direction"});
  a.Number("drift_m_per_sqrt_m", drift_m_per_sqrt_m, {"m", 0, 1, "what a way loses per root metre"});
  a.Number("drift_deg_per_sqrt_m", drift_deg_per_sqrt_m, {"deg", 0, 10, "of heading, likewise"});
  a.Number("overhang_m", overhang_m, {"m", 0.02, 2, "one sigma of a heard end beyond its wall's"});
  a.Number("least_gain", least_gain, {"-", 0, 20, "log-odds for a short wall that lies on the plan's"});
  a.Number("gain_per_m", gain_per_m, {"-", 0, 20, "more per metre of its length, up to 4 m"});
  a.Number("hidden", hidden, {"-", 0, 50, "log-odds against sound through a wall"});
  a.Number("in_wall", in_wall, {"-", 0, 50, "log-odds against each place driven over in a wall"});
}

PlaceScorer::PlaceScorer(const PlaceScoreConfig& config, const PlacePlan& plan, const DrivenWay& way)
    : config_(config), plan_(plan) {
  const Pose2 base_from_way = way.base().Inverse();
  for (const HeardPiece& heard : way.pieces) {
    Piece piece{base_from_way * heard.way_from_middle, heard.length_m};
    const double driven_m = std::max(0.0, way.driven_m - heard.at_m);
    const double yaw_drift = Radians(config.drift_deg_per_sqrt_m) * std::sqrt(driven_m);
    // The turns lie anywhere between where the piece was heard and here.
    const double lever_m =
        (piece.base_from_middle.rotation().transpose() * (base_from_way * heard.heard_from)).x();
    piece.across_variance = std::pow(config.across_m, 2) + std::pow(plan.sigma_m(), 2) +
                            std::pow(config.drift_m_per_sqrt_m, 2) * driven_m +
                            std::pow(yaw_drift * lever_m, 2) / 3;
    piece.yaw_variance = std::pow(Radians(config.turned_deg), 2) + std::pow(yaw_drift, 2);
    piece.gain = config.least_gain + config.gain_per_m * std::min(kLongest_m, heard.length_m);
    piece.heard_from = base_from_way * heard.heard_from;
    piece.foot = base_from_way * heard.NearestTo(heard.heard_from);
    pieces_.push_back(piece);
  }
  for (const Pose2& spot : way.trail) trail_.push_back(base_from_way * spot.translation());
}

std::optional<double> PlaceScorer::TurnCost(const Piece& piece, const PlaceFace& face, double map_yaw) const {
  const double turned = WrapAngle(map_yaw + piece.base_from_middle.yaw - face.yaw_rad);
  const double cost = turned * turned / piece.yaw_variance;
  if (cost > kGate * kGate) return std::nullopt;
  return cost;
}

PlaceScorer::Match PlaceScorer::BestOf(const Piece& piece, const Pose2& map_from_base) const {
  Match best;
  const Pose2 map_from_middle = map_from_base * piece.base_from_middle;
  for (const PlaceFace& face : plan_.faces()) {
    const auto turn_cost = TurnCost(piece, face, map_from_base.yaw);
    if (!turn_cost) continue;
    const Eigen::Vector2d offset = map_from_middle.translation() - face.from;
    const double across_m = face.left().dot(offset), at_m = face.along.dot(offset);
    const double overhang_m =
        std::max({0.0, piece.length_m / 2 - at_m, at_m + piece.length_m / 2 - face.length_m});
    const double cost = *turn_cost + across_m * across_m / piece.across_variance + OverhangCost(overhang_m);
    const double worth = piece.gain - cost / 2;
    if (worth <= best.worth) continue;
    best = {&face, worth, across_m, WrapAngle(map_from_middle.yaw - face.yaw_rad)};
  }
  return best;
}

double PlaceScorer::Penalty(const Pose2& map_from_base) const {
  double in_wall = 0, hidden = 0;
  for (const Eigen::Vector2d& spot : trail_) {
    if (!plan_.IsInWall(map_from_base * spot)) continue;
    in_wall += config_.in_wall;
    if (in_wall >= kMostPenalty) break;
  }
  for (const Piece& piece : pieces_) {
    const Eigen::Vector2d way = piece.foot - piece.heard_from;
    const double length_m = way.norm();
    if (length_m <= kBeforeWall_m) continue;
    const Eigen::Vector2d end = piece.heard_from + way * ((length_m - kBeforeWall_m) / length_m);
    if (plan_.Hides(map_from_base * piece.heard_from, map_from_base * end)) hidden += config_.hidden;
  }
  return -std::min(in_wall, kMostPenalty) - std::min(hidden, kMostPenalty);
}

PlaceFit PlaceScorer::FitAt(const Pose2& map_from_base, Eigen::Vector3d& gradient) const {
  PlaceFit fit{map_from_base};
  gradient.setZero();
  Eigen::Matrix2d directions = Eigen::Matrix2d::Zero();
  for (const Piece& piece : pieces_) {
    const Match match = BestOf(piece, map_from_base);
    if (!match.face) continue;
    fit.score += match.worth;
    ++fit.matched;
    const Eigen::Vector2d left = match.face->left();
    const Eigen::Vector2d lever = map_from_base.rotation() * piece.base_from_middle.translation();
    const Eigen::Vector3d by_across(left.x(), left.y(), left.dot(LeftOf(lever)));
    fit.information += by_across * by_across.transpose() / piece.across_variance;
    fit.information(2, 2) += 1 / piece.yaw_variance;
    gradient += by_across * match.across_m / piece.across_variance;
    gradient(2) += match.turned_rad / piece.yaw_variance;
    directions += left * left.transpose();
  }
  // Two walls at less than 25 degrees do not hold a place.
  constexpr double kLeastCrossing = 0.18;
  fit.crossed = directions.determinant() > kLeastCrossing * std::max(1.0, directions.trace() - 1);
  return fit;
}

PlaceFit PlaceScorer::Refined(const Pose2& map_from_base) const {
  constexpr int kSteps = 3;
  Pose2 at = map_from_base;
  Eigen::Vector3d gradient;
  for (int i = 0; i < kSteps; ++i) {
    const PlaceFit fit = FitAt(at, gradient);
    // What no wall holds stays where it is.
    Eigen::Matrix3d held = fit.information;
    held.diagonal() +=
        Eigen::Vector3d(1, 1, 1 / (kHold_rad * kHold_rad) * kHold_m * kHold_m) / (kHold_m * kHold_m);
    const Eigen::Vector3d step = held.ldlt().solve(gradient);
    at = {at.x - step.x(), at.y - step.y(), WrapAngle(at.yaw - step.z())};
  }
  PlaceFit fit = FitAt(at, gradient);
  fit.score += Penalty(at);
  return fit;
}

}  // namespace priamos::planner
