#include "planner/core/locate/leg_choice.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

constexpr double kStep_m = 0.25;
constexpr double kWidened_m = 0.4;  ///< a wall goes on beside what was heard of it
constexpr double kClosedNear_m = 0.4, kClosedCos = 0.87;
constexpr double kSlanted_m = 0.3;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

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

class Chooser {
 public:
  Chooser(const LegChoiceConfig& config, const DrivenWay& way, const std::vector<ClosedWay>& closed)
      : config_(config), way_(way), closed_(closed) {}

  double Free_m(const Eigen::Vector2d& ray) const {
    const Eigen::Vector2d at = way_.base().translation();
    for (const ClosedWay& closed : closed_)
      if ((closed.at - at).norm() < kClosedNear_m && closed.towards.dot(ray) > kClosedCos) return 0;
    double free_m = INFINITY;
    for (const HeardPiece& piece : way_.pieces)
      free_m = std::min(free_m, DistanceTo(piece, at, ray) - config_.keep_m);
    return std::min(free_m, IsOnward(ray) ? config_.longest_m : config_.first_m);
  }

  /// How much of a leg lies in what is not known.
  double New_m(const Eigen::Vector2d& ray, double length_m) const {
    double new_m = 0;
    for (double at_m = kStep_m; at_m <= length_m; at_m += kStep_m) {
      const Eigen::Vector2d place = way_.base().translation() + at_m * ray;
      const bool known = std::any_of(way_.trail.begin(), way_.trail.end(), [&](const Pose2& spot) {
        return (spot.translation() - place).norm() < std::min(config_.seen_m, at_m - 1e-6) &&
               (spot.translation() - way_.base().translation()).norm() > 1e-3;
      });
      if (!known) new_m += kStep_m;
    }
    return new_m;
  }

 private:
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
  const std::vector<ClosedWay>& closed_;
};

}  // namespace

void LegChoiceConfig::Describe(Archive& a) {
  a.Number("least_m", least_m, {"m", 0.2, 5, "the shortest leg"});
  a.Number("first_m", first_m, {"m", 0.5, 10, "a leg into the unknown"});
  a.Number("longest_m", longest_m, {"m", 0.5, 20, "a leg that leads on the same way"});
  a.Number("keep_m", keep_m, {"m", 0.5, 3, "from the base's middle to walls that were heard"});
  a.Number("seen_m", seen_m, {"m", 0.2, 5, "what lies nearer to the way driven is known"});
  a.Number("least_new_m", least_new_m, {"m", 0.1, 5, "of a leg, in unknown surroundings"});
}

std::optional<Pose2> ChooseLeg(const LegChoiceConfig& config, const DrivenWay& way,
                               const std::vector<ClosedWay>& closed) {
  const Chooser chooser(config, way, closed);
  const double axis = AxisOf(way);
  std::optional<Pose2> best;
  double best_new_m = config.least_new_m;
  for (int eighth = 0; eighth < 8; ++eighth) {
    const double angle = axis + eighth * kPi / 4;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    const double length_m = chooser.Free_m(ray);
    if (length_m < config.least_m) continue;
    // Of two legs that show as much, the one ahead.
    const double ahead = 0.1 * std::cos(angle - way.base().yaw);
    const double slanted = eighth % 2 == 1 ? kSlanted_m : 0;  // fewer walls are abeam of the base
    const double new_m = chooser.New_m(ray, length_m) + ahead - slanted;
    if (new_m <= best_new_m) continue;
    best_new_m = new_m;
    const Eigen::Vector2d end = way.base().translation() + length_m * ray;
    best = Pose2{end.x(), end.y(), way.base().yaw};
  }
  return best;
}

}  // namespace priamos::planner
