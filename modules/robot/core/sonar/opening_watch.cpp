#include "robot/core/sonar/opening_watch.hpp"

#include <algorithm>
#include <limits>

namespace priamos::robot {
namespace {

/// First sensor of the three that look to the left, and to the right.
constexpr int kLeftBeams = 5, kRightBeams = 17;
/// Cycles after which a side is free: one echo may get lost.
constexpr int kFreeCycles = 2;

/// Nearest echo of three beams; infinite when there is none.
double Nearest(const SonarCycle& cycle, int first) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = first; i < first + 3; ++i)
    if (cycle.range_m[i] >= 0 && cycle.range_m[i] <= kSonarMax_m)
      nearest = std::min(nearest, cycle.range_m[i]);
  return nearest;
}

}  // namespace

void OpeningConfig::Describe(Archive& a) {
  a.Number("near_m", near_m, {"m", 0.1, 2, "farther things on a side are not of an opening"});
  a.Number("least_m", least_m, {"m", 0.02, 2, "the base drove at least so far between near things"});
}

std::optional<Opening> OpeningWatch::Add(const SonarCycle& cycle, const Pose2& odom_from_base,
                                         const Pose2& map_from_base) {
  const double left = Nearest(cycle, kLeftBeams), right = Nearest(cycle, kRightBeams);
  if (left <= config_.near_m && right <= config_.near_m) {
    const double width_m = footprint_.width_m + left + right;
    width_m_ = first_ ? std::min(width_m_, width_m) : width_m;
    last_ = {cycle.time, odom_from_base, map_from_base};
    free_cycles_ = 0;
    if (!first_) first_ = last_;
    return std::nullopt;
  }
  if (!first_ || ++free_cycles_ < kFreeCycles) return std::nullopt;
  const auto opening = Left();
  first_.reset();
  return opening;
}

/// Nothing when the base stood, turned or went back: that is not driving through.
std::optional<Opening> OpeningWatch::Left() const {
  const Pose2 driven = first_->odom_from_base.Inverse() * last_->odom_from_base;
  if (std::abs(driven.x) < config_.least_m) return std::nullopt;
  const Pose2 middle = Integrate(first_->map_from_base, {driven.x, driven.y, driven.yaw}, 0.5);
  return Opening{first_->time + (last_->time - first_->time) / 2, middle, width_m_};
}

}  // namespace priamos::robot
