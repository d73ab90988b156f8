#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "common/config.hpp"
#include "common/time.hpp"
#include "planner/core/missions/look_sequence.hpp"
#include "planner/core/missions/mission_types.hpp"
#include "planner/core/path/door_planner.hpp"
#include "planner/core/path/passage_uncertainty.hpp"

namespace priamos::planner {

struct DoorMissionConfig {
  double speed_m_s = 0.30;       ///< on the approach and through the door
  double slowest_m_s = 0.12;     ///< on a short approach
  double look_from_m = 3.4;      ///< way to the door from which on the head may look
  double look_to_m = 2.0;        ///< way at which both sides should have been seen ...
  double looks_take_s = 3.5;     ///< ... and how long that takes, starting and radio included
  double confirm_to_m = 1.6;     ///< looks go on to here while passing; nearer, the jambs leave the picture
  double tracking_m = 0.01;      ///< what the path following may deviate in the door
  double command_delay_s = 0.2;  ///< from a decision here to the wheels there
  double resend_path_s = 4;      ///< time after which a path the robot does not confirm is sent again
  double blocked_s = 8;          ///< standing before an obstacle that ends the mission
  double silent_s = 8;           ///< silence of the robot that ends the mission
  double limit_s = 120;          ///< time for the whole mission
  LookConfig look;
  DriftModel drift;

  void Describe(Archive& a);
};

/// The mission "pass the door": approach slowly, look at the left and at the right side of the door while
/// driving, and only when both sides have corrected the pose and what is left of its uncertainty, with the
/// drift of the way still to go, fits the gap, plan through the door and go. Until then look again, in turn
/// left and right, while the robot comes nearer; at the hold point it stops by itself. On the first part of
/// the passage the looks go on: each one sharpens the pose with which the robot follows its path.
///
/// A pure state machine: time is an argument, everything heard is stored by On...(), everything is decided in
/// Tick(). Before the first order it waits and sends nothing. Its end is DONE, or FAILED with a sentence, and
/// then the robot has been told to brake.
class DoorMission {
 public:
  DoorMission(const DoorMissionConfig& config, const DoorPlannerConfig& planner, const Footprint& footprint,
              const GroundPlan& plan);
  DoorMission(const DoorMission&) = delete;
  DoorMission& operator=(const DoorMission&) = delete;

  /// A new order; refused (false) while one is being carried out.
  bool Start(Time now, int door_id);
  void Abort(Time now);

  void OnPose(const RobotPose& pose);
  void OnDrive(const DriveReport& drive, Time now);
  void OnLook(const LookResult& result) { looks_.OnResult(result); }
  /// The robot's pose was corrected at `stamp`: older poses are no longer worth planning with.
  void OnCorrected(Time stamp) { corrected_ = std::max(stamp, corrected_.value_or(stamp)); }
  void OnLink(bool up) { link_up_ = up; }

  MissionActions Tick(Time now);

  const MissionState& state() const { return state_; }
  bool running() const { return door_ && state_.phase != Phase::kDone && state_.phase != Phase::kFailed; }

 private:
  void Enter(Phase phase, std::string text);
  void Fail(std::string reason, MissionActions& actions);
  bool CheckLimits(Time now, MissionActions& actions);
  void Wait(Time now, MissionActions& actions);
  void Approach(Time now, MissionActions& actions);
  void LookAtDoor(Time now, MissionActions& actions);
  void EvaluatePose(Time now, MissionActions& actions);
  void Pass(Time now, MissionActions& actions);
  /// Takes the outcome of a look; true when it succeeded.
  bool SettleLook(Time now, MissionActions& actions);
  void AskLook(Time now, MissionActions& actions);
  bool PoseIsCorrected(Time now) const;
  void SendPath(std::vector<Pose2> points, double speed_m_s, Time now, MissionActions& actions);
  void RepeatUnconfirmedPath(Time now, MissionActions& actions);
  Pose2 PredictedPose(Time now) const;
  double WayToDoor() const;
  double ApproachSpeed(double way_m) const;

  DoorMissionConfig config_;
  DoorPlanner planner_;
  Footprint footprint_;
  GroundPlan plan_;

  const DoorPlan* door_ = nullptr;
  MissionState state_;
  Time started_{}, entered_{};
  std::optional<RobotPose> pose_;
  std::optional<DriveReport> drive_;
  std::optional<Time> blocked_since_;
  bool link_up_ = false;
  bool aborted_ = false;
  std::optional<Time> corrected_;
  LookSequence looks_;
  bool judge_ = false;  ///< a look succeeded and enough have: the pose is to be judged when it has come
  PathOrder path_;
  Time path_sent_{};
  int last_id_ = 0;
};

}  // namespace priamos::planner
