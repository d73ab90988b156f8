#include "robot/core/sonar/near_map.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kCell = 0.04;
// A beam that ends this far behind a thing has gone through its place; less may be the thing's own size.
constexpr double kBehind = 0.2;
constexpr double kSurelyStands_m_s = 0.01, kStands_rad_s = 0.02;

}  // namespace

void NearMapConfig::Describe(Archive& a) {
  a.Number("keep_m", keep_m, {"m", 0, 2, "only echoes this near are kept; 0 keeps none"});
  a.Number("keep_s", keep_s,
           {"s", 0.1, 60, "how long a thing is kept that is not seen again, while the base moves"});
  a.Number("keep_standing_s", keep_standing_s,
           {"s", 0.1, 600, "how long it is kept while the base stands and has no path to follow"});
  a.Number("forget_m", forget_m, {"m", 0.5, 10, "things farther from the base centre are forgotten"});
  a.Number("through_deg", through_deg, {"deg", 0, 15, "half width of the part of a beam that clears"});
}

void NearMap::Add(const Pose2& odom_from_sonar, double range_m) {
  if (!(range_m <= config_.keep_m)) return;
  const Eigen::Vector2d point = odom_from_sonar * Eigen::Vector2d(range_m, 0);
  const Cell cell{static_cast<int>(std::floor(point.x() / kCell)),
                  static_cast<int>(std::floor(point.y() / kCell))};
  things_[cell] = {point, clock_s_};
}

void NearMap::Clear(const Pose2& odom_from_sonar, double range_m) {
  const Pose2 sonar_from_odom = odom_from_sonar.Inverse();
  std::erase_if(things_, [&](const auto& entry) {
    const Eigen::Vector2d seen = sonar_from_odom * entry.second.in_odom;
    const bool on_axis = std::abs(std::atan2(seen.y(), seen.x())) < Radians(config_.through_deg);
    return on_axis && seen.norm() < range_m - kBehind;
  });
}

bool NearMap::Stands(const Pose2& odom_from_base, double dt_s) const {
  const Pose2 step = here_.Inverse() * odom_from_base;
  return step.translation().norm() <= kSurelyStands_m_s * dt_s && std::abs(step.yaw) <= kStands_rad_s * dt_s;
}

void NearMap::Forget(const Pose2& odom_from_base, Time now, bool waits) {
  const double dt_s = now_ ? std::max(Seconds(now - *now_), 0.0) : 0;
  const bool slowly = !waits && Stands(odom_from_base, dt_s);
  clock_s_ += dt_s * (slowly ? config_.keep_s / config_.keep_standing_s : 1);
  now_ = now;
  here_ = odom_from_base;
  const Eigen::Vector2d here = here_.translation();
  std::erase_if(things_, [&](const auto& entry) {
    return clock_s_ - entry.second.seen_s > config_.keep_s ||
           (entry.second.in_odom - here).norm() > config_.forget_m;
  });
}

std::vector<Eigen::Vector2d> NearMap::Points(const Pose2& odom_from_base) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::vector<Eigen::Vector2d> points;
  points.reserve(things_.size());
  for (const auto& [cell, thing] : things_) points.push_back(base_from_odom * thing.in_odom);
  return points;
}

}  // namespace priamos::robot
