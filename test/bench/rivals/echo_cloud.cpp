#include "test/bench/rivals/echo_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/robot/body_size.hpp"

namespace priamos::bench {
namespace {

constexpr double kCell_m = 0.05;

Eigen::Vector2d CentreOf(const std::pair<int, int>& cell) {
  return kCell_m * Eigen::Vector2d(cell.first + 0.5, cell.second + 0.5);
}

}  // namespace

void EchoCloudConfig::Describe(Archive& a) {
  a.Number("reach_m", reach_m, {"m", 0.3, 5, "echoes from farther away are left out"});
  a.Number("half_arc_deg", half_arc_deg, {"deg", 0, 15, "part of the beam on which an echo is marked"});
  a.Number("through_deg", through_deg, {"deg", 0, 15, "part of the beam that shows that there is nothing"});
  a.Number("through_m", through_m, {"m", 0, 1, "nearer to the echo than this nothing is cleared"});
  a.Number("keep_s", keep_s, {"s", 0.1, 600, "how long a mark counts"});
  a.Number("near_m", near_m, {"m", 0, 5, "an echo from nearer counts at once"});
}

void EchoCloud::Add(const robot::SonarCycle& cycle, const Pose2& odom_from_base, Time now) {
  std::erase_if(marks_, [&](const auto& mark) { return Seconds(now - mark.second.newest) > config_.keep_s; });
  const Eigen::Vector2d footprint(kDrawnBody.length_m, kDrawnBody.width_m);
  for (int i = 0; i < kSonars; ++i) {
    const double range_m = cycle.range_m[std::size_t(i)];
    if (!robot::IsEcho(range_m)) continue;  // a smooth wall gives none, too
    const Pose2 odom_from_sonar = odom_from_base * BaseFromSonar(i, footprint);
    Clear(odom_from_sonar, range_m);
    if (range_m <= config_.reach_m) Put(odom_from_sonar, range_m, now);
  }
}

void EchoCloud::Clear(const Pose2& odom_from_sonar, double range_m) {
  const Pose2 sonar_from_odom = odom_from_sonar.Inverse();
  std::erase_if(marks_, [&](const auto& mark) {
    const Eigen::Vector2d at = sonar_from_odom * CentreOf(mark.first);
    return at.norm() < range_m - config_.through_m &&
           std::abs(std::atan2(at.y(), at.x())) < Radians(config_.through_deg);
  });
}

/// A cell counts an echo once, however much of the arc lies in it.
void EchoCloud::Put(const Pose2& odom_from_sonar, double range_m, Time now) {
  const double half = Radians(config_.half_arc_deg);
  const int steps = int(std::ceil(2 * half * range_m / kCell_m)) + 1;
  std::set<Cell> cells;
  for (int i = 0; i <= steps; ++i) {
    const double angle = half * (2.0 * i / steps - 1);
    const Eigen::Vector2d at =
        odom_from_sonar * Eigen::Vector2d(range_m * std::cos(angle), range_m * std::sin(angle));
    cells.insert({int(std::floor(at.x() / kCell_m)), int(std::floor(at.y() / kCell_m))});
  }
  for (const Cell& cell : cells) {
    Mark& mark = marks_[cell];
    mark.echoes += range_m < config_.near_m ? 2 : 1;
    mark.newest = now;
  }
}

std::vector<Eigen::Vector2d> EchoCloud::Points(const Pose2& odom_from_base) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::vector<Eigen::Vector2d> points;
  for (const auto& [cell, mark] : marks_)
    if (mark.echoes >= 2) points.push_back(base_from_odom * CentreOf(cell));
  return points;
}

}  // namespace priamos::bench
