#include <cmath>

#include "planner/core/missions/explore_mission.hpp"

// How a robot is told where it is while it explores.

namespace priamos::planner {
namespace {

/// A robot that knows its place worse is told where it is, so well; it stands then, for so long at least.
constexpr double kVague_m = 0.3, kVague_rad = Radians(6), kPlaced_m = 0.05, kPlaced_rad = Radians(0.6);
constexpr double kStands = 0.01, kSettled_s = 1.0;

}  // namespace

/// A robot holds when it does not know where it is in its own frame. Where it is on the map is known better,
/// and its own frame is what it says: so it is told that it is there, before it holds.
bool ExploreMission::IsVague(const MissionControl& control) const {
  const Eigen::Matrix3d& covariance = control.heard().pose->covariance;
  return placing_ != Placing::kNo || covariance(0, 0) + covariance(1, 1) > kVague_m * kVague_m ||
         covariance(2, 2) > kVague_rad * kVague_rad;
}

/// It has to stand before it can be told. In the end it is told where it is on the map: from then on its pose
/// is that of the map.
void ExploreMission::Place(MissionControl& control) {
  const RobotPose& pose = *control.heard().pose;
  if (placing_ == Placing::kNo) {
    placing_ = Placing::kBrakes;
    braked_ = control.now();
    return control.OrderPath({}, 0);
  }
  if (placing_ == Placing::kBrakes) {
    const bool stands = std::hypot(pose.velocity.vx, pose.velocity.vy, pose.velocity.wz) < kStands;
    if (!stands || Seconds(pose.stamp - braked_) < kSettled_s) return;
    placing_ = Placing::kTold;
    return control.OrderPlace(outcome_ ? BaseOf(control) : pose.map_from_base, kPlaced_m, kPlaced_rad);
  }
  if (control.IsPlacing()) return;
  placing_ = Placing::kNo;
  if (outcome_) return End(control);
  Next(control);
}

}  // namespace priamos::planner
