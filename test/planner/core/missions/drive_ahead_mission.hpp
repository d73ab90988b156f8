#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/core/missions/mission.hpp"

namespace priamos::planner {

/// A second mission, for tests alone: has the head look at a landmark, drives 1 m ahead when it was found,
/// and is done when the robot has arrived.
class DriveAheadMission : public Mission {
 public:
  std::optional<Refusal> Start(const MissionOrder& order) override {
    landmark_id_ = order.landmark_id;
    request_id_ = 0;
    if (landmark_id_ == 0) return Refusal{"there is no landmark 0"};
    return std::nullopt;
  }
  void Step(MissionControl& control) override {
    switch (control.state().phase) {
      case Phase::kWaiting:
        return Look(control);
      case Phase::kLookingLeft:
        return Drive(control);
      default:
        return Arrive(control);
    }
  }
  const MissionLimits& limits() const override { return limits_; }
  std::string Unfinished() const override { return "not 1 m ahead"; }

 private:
  void Look(MissionControl& control) {
    if (!control.heard().pose) return;
    request_id_ = control.OrderLook(landmark_id_, Side::kLeft);
    control.Enter(Phase::kLookingLeft, "looking");
  }
  void Drive(MissionControl& control) {
    for (const LookResult& look : control.heard().looks) {
      if (look.request_id != request_id_) continue;
      if (!look.ok) return control.Fail("nothing seen: " + look.reason);
      control.OrderPath({.points = {control.heard().pose->map_from_base * Pose2{1, 0, 0}}}, 0.2);
      control.Enter(Phase::kPassing, "driving ahead");
    }
  }
  void Arrive(MissionControl& control) {
    if (control.OnPath() && control.heard().drive->mode == DriveMode::kArrived)
      control.Enter(Phase::kDone, "1 m ahead");
  }

  MissionLimits limits_{.resend_path_s = 2, .blocked_s = 3, .silent_s = 4, .limit_s = 10};
  int landmark_id_ = 0, request_id_ = 0;
};

}  // namespace priamos::planner
