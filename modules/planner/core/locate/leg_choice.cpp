#include "planner/core/locate/leg_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/cross.hpp"

namespace priamos::planner {
namespace {

constexpr double kStep_m = 0.25;
constexpr double kWidened_m = 0.4;  ///< a wall goes on beside what was heard of it
constexpr double kClosedNear_m = 0.4, kClosedCos = 0.87;
constexpr double kSlanted_m = 0.3;
constexpr double kHalfBase_m = 0.45;                ///< between half its width and half its length
constexpr double kBack_m = 0.12, kBack_rad = 0.15;  ///< a base so near to where it was is back there
constexpr double kBeside_m = 0.1;                   ///< lines of a way back, of the way driven

/// How far it is to a piece from `from` in a direction of length 1.
double DistanceTo(const HeardPiece& piece, const Eigen::Vector2d& from, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d begin = piece.At(-piece.length_m / 2 - kWidened_m);
  const Eigen::Vector2d line = piece.At(piece.length_m / 2 + kWidened_m) - begin;
  const double turned = Cross(ray, line);
  if (std::abs(turned) < 1e-6) return INFINITY;
  const double distance_m = Cross(begin - from, line) / turned, part = Cross(begin - from, ray) / turned;
  return distance_m > 0 && part >= 0 && part <= 1 ? distance_m : INFINITY;
}

/// The direction of the walls; of the base while none was heard.
double AxisOf(const DrivenWay& way) {
  return way.pieces.empty() ? way.base().yaw : way.pieces.front().way_from_middle.yaw;
}

/// How far the middle of a base gets before it meets a thing.
double DistanceTo(const Rectangle& thing, const Eigen::Vector2d& from, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d to = thing.map_from_centre.translation() - from;
  const double reach_m = thing.half_m.minCoeff() + kHalfBase_m, ahead_m = ray.dot(to);
  if (ahead_m <= 0 || std::abs(Cross(ray, to)) > reach_m) return INFINITY;
  return std::max(0.0, ahead_m - reach_m);
}

class Chooser {
 public:
  Chooser(const LegChoiceConfig& config, const DrivenWay& way, const LegHints& hints)
      : config_(config), way_(way), hints_(hints), axis_(AxisOf(way)) {}

  struct Leg {
    Pose2 end;
    double new_m = 0;
  };

  /// The best leg from a place of the trail; `last`: the base stands there.
  std::optional<Leg> Best(const Pose2& from, bool last) const {
    std::optional<Leg> best;
    for (int eighth = 0; eighth < 8; ++eighth) {
      const double angle = axis_ + eighth * kPi / 4;
      const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
      const double length_m = Free_m(from.translation(), ray, last);
      if (length_m < config_.least_m) continue;
      // Of two legs that show as much, the one ahead.
      const double ahead = 0.1 * std::cos(angle - from.yaw);
      const double slanted = eighth % 2 == 1 ? kSlanted_m : 0;  // fewer walls are abeam of the base
      const double told = config_.told_gain * Told_m(from.translation(), ray, length_m);
      const double new_m = New_m(from.translation(), ray, length_m) + told + ahead - slanted;
      if (new_m <= (best ? best->new_m : config_.least_new_m)) continue;
      const Eigen::Vector2d end = from.translation() + length_m * ray;
      best = Leg{{end.x(), end.y(), Aligned(from.yaw)}, new_m};
    }
    return best;
  }

 private:
  double Free_m(const Eigen::Vector2d& at, const Eigen::Vector2d& ray, bool last) const {
    for (const ClosedWay& closed : hints_.closed)
      if ((closed.at - at).norm() < kClosedNear_m && closed.towards.dot(ray) > kClosedCos) return 0;
    double free_m = INFINITY;
    for (const HeardPiece& piece : way_.pieces)
      free_m = std::min(free_m, DistanceTo(piece, at, ray) - config_.keep_m);
    for (const Rectangle& thing : hints_.things) free_m = std::min(free_m, DistanceTo(thing, at, ray));
    const double short_m = std::min(free_m, config_.first_m), long_m = std::min(free_m, config_.longest_m);
    const bool goes_on = last && IsOnward(ray);
    return goes_on || Told_m(at, ray, long_m) > Told_m(at, ray, short_m) ? long_m : short_m;
  }

  /// By how much the rivals differ in how far such a leg can be driven.
  double Told_m(const Eigen::Vector2d& from, const Eigen::Vector2d& ray, double length_m) const {
    if (hints_.rivals.size() < 2) return 0;
    double least_m = length_m, most_m = 0;
    for (const Pose2& rival : hints_.rivals) {
      const double free_m = hints_.plan->Free_m(rival * from, rival.rotation() * ray, length_m);
      least_m = std::min(least_m, free_m);
      most_m = std::max(most_m, free_m);
    }
    return most_m - least_m;
  }

  /// The nearest heading along or across the walls.
  double Aligned(double yaw) const {
    if (way_.pieces.empty() || way_.pieces.front().length_m < config_.aligned_m) return yaw;
    return WrapAngle(axis_ + std::round((yaw - axis_) / (kPi / 2)) * kPi / 2);
  }

  /// How much of a leg lies in what is not known.
  double New_m(const Eigen::Vector2d& from, const Eigen::Vector2d& ray, double length_m) const {
    double new_m = 0;
    for (double at_m = kStep_m; at_m <= length_m; at_m += kStep_m) {
      const Eigen::Vector2d place = from + at_m * ray;
      const bool known = std::any_of(way_.trail.begin(), way_.trail.end(), [&](const Pose2& spot) {
        return (spot.translation() - place).norm() < std::min(config_.seen_m, at_m - 1e-6) &&
               (spot.translation() - from).norm() > 1e-3;
      });
      if (!known) new_m += kStep_m;
    }
    return new_m;
  }

  /// Whether the base came that way for a while.
  bool IsOnward(const Eigen::Vector2d& ray) const {
    const Eigen::Vector2d at = way_.base().translation();
    double back_m = 0;
    for (auto spot = way_.trail.rbegin(); spot != way_.trail.rend(); ++spot) {
      const Eigen::Vector2d came = at - spot->translation();
      if (std::abs(Cross(ray, came)) > config_.seen_m || came.dot(ray) < back_m - kStep_m) break;
      back_m = std::max(back_m, came.dot(ray));
    }
    return back_m > config_.first_m / 2;
  }

  const LegChoiceConfig& config_;
  const DrivenWay& way_;
  const LegHints& hints_;
  double axis_;
};

/// Of the places strictly between two of the trail that which lies farthest beside their line.
std::pair<std::size_t, double> FarthestBeside(const std::vector<Pose2>& trail, std::size_t from,
                                              std::size_t to) {
  std::pair<std::size_t, double> farthest{from, 0};
  for (std::size_t i = std::min(from, to) + 1; i < std::max(from, to); ++i) {
    const double beside_m =
        DistanceToSegment(trail[from].translation(), trail[to].translation(), trail[i].translation());
    if (beside_m > farthest.second) farthest = {i, beside_m};
  }
  return farthest;
}

}  // namespace

void LegChoiceConfig::Describe(Archive& a) {
  a.Number("least_m", least_m, {"m", 0.2, 5, "the shortest leg"});
  a.Number("first_m", first_m, {"m", 0.5, 10, "a leg into the unknown"});
  a.Number("longest_m", longest_m, {"m", 0.5, 20, "a leg that leads on the same way"});
  a.Number("keep_m", keep_m, {"m", 0.5, 3, "from the base's middle to walls that were heard"});
  a.Number("seen_m", seen_m, {"m", 0.2, 5, "what lies nearer to the way driven is known"});
  a.Number("least_new_m", least_new_m, {"m", 0.1, 5, "of a leg, in unknown surroundings"});
  a.Number("back_gain", back_gain, {"-", 0, 2, "of it, for each metre driven back to where it begins"});
  a.Number("told_gain", told_gain, {"-", 0, 10, "of a leg, per metre by which places differ in its length"});
  a.Number("aligned_m", aligned_m, {"m", 0.2, 100, "of a wall, along which the base then turns"});
}

std::optional<Pose2> ChooseLeg(const LegChoiceConfig& config, const DrivenWay& way, const LegHints& hints) {
  const auto best = Chooser(config, way, hints).Best(way.base(), true);
  if (!best) return std::nullopt;
  return best->end;
}

std::vector<Pose2> WithoutLoops(const std::vector<Pose2>& trail) {
  std::vector<Pose2> kept;
  for (const Pose2& spot : trail) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Pose2& before) {
      return (before.translation() - spot.translation()).norm() < kBack_m &&
             std::abs(WrapAngle(before.yaw - spot.yaw)) < kBack_rad;
    });
    if (same != kept.end()) kept.erase(same + 1, kept.end());
    kept.push_back(spot);
  }
  return kept;
}

std::vector<Pose2> AlongTrail(const std::vector<Pose2>& trail, std::size_t from, std::size_t to) {
  const auto [corner, beside_m] = FarthestBeside(trail, from, to);
  if (beside_m <= kBeside_m) return {trail[to]};
  std::vector<Pose2> points = AlongTrail(trail, from, corner);
  const std::vector<Pose2> rest = AlongTrail(trail, corner, to);
  points.insert(points.end(), rest.begin(), rest.end());
  return points;
}

std::vector<Pose2> ChooseWayBack(const LegChoiceConfig& config, const DrivenWay& way, const LegHints& hints) {
  const Chooser chooser(config, way, hints);
  const std::vector<Pose2> trail = WithoutLoops(way.trail);
  std::optional<std::size_t> best;
  double most = 0, back_m = 0;
  for (std::size_t i = trail.size() - 1; i-- > 0;) {
    back_m += (trail[i + 1].translation() - trail[i].translation()).norm();
    const auto leg = chooser.Best(trail[i], false);
    if (!leg || leg->new_m - config.back_gain * back_m <= most) continue;
    most = leg->new_m - config.back_gain * back_m;
    best = i;
  }
  if (!best) return {};
  return AlongTrail(trail, trail.size() - 1, *best);
}

}  // namespace priamos::planner
