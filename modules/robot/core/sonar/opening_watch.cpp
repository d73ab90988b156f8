#include "robot/core/sonar/opening_watch.hpp"

#include <algorithm>
#include <limits>

namespace priamos::robot {
namespace {

/// First sensor of the three that look to the left, and to the right.
constexpr int kLeftBeams = 5, kRightBeams = 17;
/// Cycles after which a side is free: one echo may get lost.
constexpr int kFreeCycles = 2;
/// Cycles after which both sides are farther apart: the difference is not much more than the ranges' noise.
constexpr int kWideCycles = 5;

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
  a.Number("widen_m", widen_m,
           {"m", 0.01, 1, "sides that stay near end an opening when so much farther apart"});
}

std::optional<Opening> OpeningWatch::Add(const SonarCycle& cycle, const Pose2& odom_from_base,
                                         const Pose2& map_from_base) {
  const double left = Nearest(cycle, kLeftBeams), right = Nearest(cycle, kRightBeams);
  if (left <= config_.near_m && right <= config_.near_m) {
    const double width_m = footprint_.width_m + left + right;
    const Moment now{cycle.time, odom_from_base, map_from_base};
    near_ =
        near_ ? Section{near_->first, now, std::min(near_->width_m, width_m)} : Section{now, now, width_m};
    free_cycles_ = 0;
    return EndNarrowest(now, width_m);
  }
  if (!near_ || ++free_cycles_ < kFreeCycles) return std::nullopt;
  const auto opening = Left(*near_);
  near_.reset();
  narrowest_.reset();
  return opening;
}

/// Keeps to the narrowest part of what is near on both sides, and ends it when the base has left that.
std::optional<Opening> OpeningWatch::EndNarrowest(const Moment& now, double width_m) {
  if (!narrowest_ || width_m < narrowest_->width_m - config_.widen_m) {
    narrowest_ = Section{now, now, width_m};
    wide_cycles_ = 0;
  } else if (width_m <= narrowest_->width_m + config_.widen_m) {
    narrowest_ = Section{narrowest_->first, now, std::min(narrowest_->width_m, width_m)};
    wide_cycles_ = 0;
  } else if (++wide_cycles_ >= kWideCycles) {
    const auto opening = Left(*narrowest_);
    near_.reset();
    narrowest_.reset();
    return opening;
  }
  return std::nullopt;
}

/// Nothing when the base stood, turned or went back: that is not driving through.
std::optional<Opening> OpeningWatch::Left(const Section& section) const {
  const auto& [first, last, width_m] = section;
  const Pose2 driven = first.odom_from_base.Inverse() * last.odom_from_base;
  if (std::abs(driven.x) < config_.least_m) return std::nullopt;
  const Pose2 middle = Integrate(first.map_from_base, {driven.x, driven.y, driven.yaw}, 0.5);
  return Opening{first.time + (last.time - first.time) / 2, middle, width_m};
}

}  // namespace priamos::robot
