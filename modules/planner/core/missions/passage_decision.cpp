#include "planner/core/missions/passage_decision.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace priamos::planner {

void PassageRules::Describe(Archive& a) {
  a.Number("last_look_m", last_look_m,
           {"m", 0, 10, "distance to the door from which the last look is expected"});
  a.Number("commit_m", commit_m,
           {"m", 0, 10, "distance to the door at which the pose is judged for the last time"});
  a.Number("slow_commit_m", slow_commit_m,
           {"m", 0, 10,
            "the same for a base that drives slowest_m_s, as it does where looks from nearer would do"});
  if (slow_commit_m > commit_m) a.Refuse("slow_commit_m", "at most commit_m");
  a.Number("tracking_m", tracking_m, {"m", 0, 0.1, "what the path following may deviate in the door"});
  a.Section("drift", drift, "what the wheels add on the way to the door");
}

std::string PassageProspect::Text() const {
  return fmt::format("2 sigma at the door {:.3f} m and {:.1f} degrees", 2 * uncertainty.lateral_sigma_m,
                     Degrees(2 * uncertainty.heading_sigma_rad));
}

PassageProspect PassageDecision::Expect(const DoorPlan& door, const Eigen::Matrix3d& covariance,
                                        double distance_m, double last_look_m) const {
  const Pose2 there = door.map_from_door() * Pose2{-std::clamp(distance_m, 0.0, last_look_m), 0, 0};
  const PassageUncertainty uncertainty = AtDoor(door, there, covariance, rules_.drift);
  return {uncertainty, GapLeft(door, footprint_, uncertainty, rules_.tracking_m)};
}

PassageStep PassageDecision::Next(const DoorPlan& door, const Eigen::Matrix3d& covariance,
                                  double distance_m) {
  if (settled_ || distance_m > rules_.commit_m) return PassageStep::kWait;
  settled_ = Expect(door, covariance, distance_m, distance_m).Fits();
  if (settled_) return PassageStep::kEnter;
  if (slow_ && distance_m > rules_.slow_commit_m) return PassageStep::kWait;
  if (!slow_ && Expect(door, covariance, distance_m, rules_.slow_commit_m).Fits()) {
    slow_ = true;
    return PassageStep::kSlowDown;
  }
  settled_ = true;
  return PassageStep::kGoBack;
}

}  // namespace priamos::planner
