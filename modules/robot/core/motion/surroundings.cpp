#include "robot/core/motion/surroundings.hpp"

#include <algorithm>
#include <iterator>

namespace priamos::robot {
namespace {

constexpr double kBeside = 0.5;  ///< [m] from the base: so near, an arc is narrow enough for a place

void Append(const std::vector<Eigen::Vector2d>& more, std::vector<Eigen::Vector2d>& points) {
  points.insert(points.end(), more.begin(), more.end());
}

}  // namespace

Surroundings::Surroundings(const DriveConfig& config)
    : footprint_(config.footprint),
      echoes_(config.echoes, config.footprint),
      floor_(config.floor),
      hanging_(config.hanging, config.footprint),
      movers_(config.movers, config.footprint),
      approach_(config.approach, config.footprint) {}

/// The evidence is of what stays: somebody who has walked by is not to block the way for half a minute.
void Surroundings::AddSonar(const SonarCycle& cycle, const Pose2& odom_from_base, bool heeds_movers) {
  movers_.Add(cycle, odom_from_base);
  approach_.Add(cycle, odom_from_base);
  echoes_.Add(cycle, odom_from_base,
              [&](const Eigen::Vector2d& odom) { return !heeds_movers || !movers_.IsOfMover(odom); });
}

void Surroundings::Forget(const Pose2& odom_from_base, Time now, bool driving) {
  echoes_.Forget(odom_from_base, now, driving);
  floor_.Forget(odom_from_base, now);
  hanging_.Forget(odom_from_base, now);
}

Obstacles Surroundings::Around(const Pose2& odom_from_base, bool bridges, bool heeds_movers) const {
  Obstacles around{echoes_.Points(odom_from_base), echoes_.Remembered(odom_from_base),
                   floor_.Points(odom_from_base)};
  Append(hanging_.Points(odom_from_base), around.placed);
  if (heeds_movers) Append(movers_.Points(odom_from_base), around.placed);
  if (bridges) Append(echoes_.Bridges(odom_from_base), around.seen);
  Append(around.placed, around.seen);
  return around;
}

std::vector<Eigen::Vector2d> Surroundings::ToLeadAround(const Obstacles& around, const Pose2& odom_from_base,
                                                        Time now) const {
  std::vector<Eigen::Vector2d> things = echoes_.Evidence(odom_from_base, now);
  Append(around.remembered, things);
  std::copy_if(around.seen.begin(), around.seen.end(), std::back_inserter(things),
               [&](const Eigen::Vector2d& p) { return footprint_.Distance(p) < kBeside; });
  Append(around.placed, things);
  return things;
}

bool Surroundings::IsAboutToMeet(const Pose2& odom_from_base, const Eigen::Vector2d& velocity,
                                 double within_s) const {
  return approach_.Meets(velocity, within_s) || movers_.IsAboutToMeet(odom_from_base, velocity, within_s);
}

}  // namespace priamos::robot
