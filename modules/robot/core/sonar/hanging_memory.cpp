#include "robot/core/sonar/hanging_memory.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kPointsApart_m = 0.04;   // of the points of an outline
constexpr double kSurelyInside_m = 0.08;  // so deep within the footprint nothing can be
constexpr double kMostThing_m = 5.1;

/// Points on the way from one corner to the next, without the last one.
void AddOutline(const Pose2& odom_from_front, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                std::vector<Eigen::Vector2d>& points) {
  const int n = 1 + static_cast<int>((to - from).norm() / kPointsApart_m);
  for (int i = 0; i < n; ++i) points.push_back(odom_from_front * Eigen::Vector2d(from + (to - from) * i / n));
}

}  // namespace

void HangingConfig::Describe(Archive& a) {
  a.Number("low_m", low_m, {"m", 0, 2, "things that begin lower are heard by the sonars"});
  a.Number("high_m", high_m, {"m", 0, 3, "things that begin higher are above the robot; 0: none counts"});
  a.Number("max_thickness_m", max_thickness_m, {"m", 0.05, 1, "of a top or its border; thicker is a face"});
  a.Number("max_sigma_m", max_sigma_m, {"m", 0, 0.63, "what is known worse is left to the planner"});
  a.Number("keep_s", keep_s, {"s", 0, 3600, "how long a thing counts that is not seen again"});
  a.Number("reach_m", reach_m, {"m", 0.5, 10, "things farther from the base centre do not count yet"});
}

bool HangingMemory::Counts(const SeenThing& thing) const {
  return !thing.is_edge && !thing.has_gone && thing.bottom_m >= config_.low_m &&
         thing.bottom_m < config_.high_m && thing.top_m - thing.bottom_m <= config_.max_thickness_m &&
         thing.sigma_m <= config_.max_sigma_m && std::max(thing.width_m, thing.depth_m) <= kMostThing_m;
}

void HangingMemory::Take(const SeenThing& thing, const Pose2& odom_from_map) {
  // A head that began anew gives a number a second time.
  if (!Counts(thing)) {
    things_.erase(thing.id);
    return;
  }
  Kept& kept = things_[thing.id];
  kept.seen = thing.seen;
  kept.in_odom.clear();
  const Pose2 odom_from_front = odom_from_map * thing.map_from_front;
  const double half = thing.width_m / 2, depth = thing.depth_m;
  const Eigen::Vector2d right(0, -half), left(0, half), left_behind(depth, half), right_behind(depth, -half);
  AddOutline(odom_from_front, right, left, kept.in_odom);
  AddOutline(odom_from_front, left, left_behind, kept.in_odom);
  if (depth > 0) AddOutline(odom_from_front, left_behind, right_behind, kept.in_odom);
  if (depth > 0) AddOutline(odom_from_front, right_behind, right, kept.in_odom);
}

void HangingMemory::Forget(const Pose2& odom_from_base, Time now) {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::erase_if(things_, [&](const auto& entry) {
    if (Seconds(now - entry.second.seen) > config_.keep_s) return true;
    return std::any_of(entry.second.in_odom.begin(), entry.second.in_odom.end(),
                       [&](const Eigen::Vector2d& at) {
                         return footprint_.Distance(base_from_odom * at) < -kSurelyInside_m;
                       });
  });
}

std::vector<Eigen::Vector2d> HangingMemory::Points(const Pose2& odom_from_base) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::vector<Eigen::Vector2d> points;
  for (const auto& [id, kept] : things_) {
    for (const Eigen::Vector2d& at : kept.in_odom) {
      const Eigen::Vector2d in_base = base_from_odom * at;
      if (in_base.norm() < config_.reach_m) points.push_back(in_base);
    }
  }
  return points;
}

}  // namespace priamos::robot
