#pragma once

#include <optional>
#include <string>

#include "common/archive.hpp"
#include "common/time.hpp"
#include "planner/core/missions/leaf_belief.hpp"
#include "planner/core/missions/look_sequence.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/missions/passage_decision.hpp"
#include "planner/core/path/door_planner.hpp"

namespace priamos::planner {

/// Speeds, distances to the door, and time limits of a mission through a door.
struct DoorMissionConfig {
  double speed_m_s = 0.30;    ///< on the approach and through the door
  double slowest_m_s = 0.12;  ///< on a short approach
  double look_from_m = 3.4;   ///< distance to the door from which on the head may look
  double look_to_m = 2.0;     ///< distance at which both sides should have been seen ...
  double looks_take_s = 3.5;  ///< ... and how long that takes, starting and radio included
  double stand_back_m = 2.6;  ///< to where it goes back, once, when looks from nearer all failed; 0: never
  double one_side_m = 1.8;    ///< nearer, a picture holds one side only: looks stay on one
  double confirm_to_m = 0.7;  ///< looks go on to here while passing; nearer, the head follows the door itself
  double command_delay_s = 0.2;  ///< from a decision here to the wheels there
  double evidence_s = 4;         ///< how long the sonars' report of the opening may be on its way
  int retries = 1;               ///< how often it tries again after an obstacle in the door
  MissionLimits limits;
  LookConfig look;
  PassageRules passage;

  void Describe(Archive& a);
};

/// The mission "pass the door": approach slowly, look at the left and at the right side of the door while
/// driving, and only when both sides have corrected the pose and what is left of its uncertainty, with the
/// drift of the distance still to go, fits the gap, plan through the door and go. Until then look again, in
/// turn left and right, while the robot comes nearer; at the hold point it stops by itself. When all looks
/// from there fail, as a picture from near holds too little of a door, it goes back once and looks from
/// there. On the first part of the passage the looks go on: each one sharpens the pose with which the robot
/// follows its path. A robot that is stopped in the door goes back to the hold point, and tries again unless
/// it touched something: the doorway is left free. When the looks agree that the leaf leaves too narrow a
/// way, the mission ends before the door. A door that has a landmark on its far side (`behind_id`) is passed
/// from there in the same way, except that nothing is known of its leaf. A cabin has no room for looks on the
/// way out: a robot that came in through this door last leaves by the pose that it was passed with.
class DoorMission : public Mission {
 public:
  DoorMission(const DoorMissionConfig& config, const DoorPlannerConfig& planner, const Footprint& footprint,
              const GroundPlan& plan);
  DoorMission(const DoorMission&) = delete;
  DoorMission& operator=(const DoorMission&) = delete;

  /// Begins the mission; it is refused unless the order's landmark is a door of the plan.
  std::optional<Refusal> Start(const MissionOrder& order) override;
  void Step(MissionControl& control) override;
  void OnStop(MissionControl& control, const Stop& stop) override;
  /// Changes speeds, distances and times; what was ordered with others stays.
  void set_config(const DoorMissionConfig& config) {
    config_ = config;
    decision_.set_rules(config.passage);
  }
  const MissionLimits& limits() const override { return config_.limits; }
  std::string Unfinished() const override { return "not through the door"; }

 private:
  void Wait(MissionControl& control);
  /// Takes the side on which the robot stands as the one to come from.
  std::optional<Refusal> ChooseSide(const Pose2& map_from_base);
  bool FromBehind() const { return front_ && door_->id != front_->id; }
  void Approach(MissionControl& control);
  void Leave(MissionControl& control);
  void LookAtDoor(MissionControl& control);
  void EvaluatePose(MissionControl& control);
  /// Orders the path through the door; false: there is none, and the mission has failed.
  bool SetOut(MissionControl& control, double speed_m_s);
  void Confirm(MissionControl& control, double distance_m);
  void Commit(MissionControl& control, double distance_m);
  void Pass(MissionControl& control);
  void Arrive(MissionControl& control);
  void Retreat(MissionControl& control);
  /// Goes to where a picture holds the whole door; false: it stands there, or did so, or there is no way.
  bool StandBack(MissionControl& control);
  void TryAgain(MissionControl& control);
  /// Why the leaf leaves no way for the base; nullopt: it does, or nobody knows.
  std::optional<std::string> LeafInTheWay() const;
  /// Takes what the looks show of the leaf; true when the mission has ended because of it.
  bool JudgeLeaf(MissionControl& control);
  bool DoorWasNoticed(const MissionControl& control) const;
  /// Takes the outcome of a look; true when it succeeded.
  bool SettleLook(MissionControl& control);
  void NoteArrivalAtHold(const MissionControl& control);
  /// Whether looking is given up: not while the base drives, for it sees from elsewhere soon.
  bool LooksUsedUp() const { return at_hold_ && looks_.Exhausted(); }
  void AskLook(MissionControl& control);
  void LookFromHere(MissionControl& control);
  Pose2 PredictedPose(const MissionControl& control) const;
  /// Distance from the robot to the plane of the door along the door's axis [m]; negative behind it.
  double DistanceToDoor(const MissionControl& control) const;
  double ApproachSpeed(double distance_m) const;

  DoorMissionConfig config_;
  DoorPlanner planner_;
  Footprint footprint_;
  GroundPlan plan_;

  const DoorPlan* front_ = nullptr;  ///< the door of the plan ...
  std::optional<DoorPlan> door_;     ///< ... as it is from where the robot comes
  Time entered_{};                   ///< when the approach began
  LookSequence looks_;
  PassageDecision decision_;
  LeafBelief leaf_;
  std::optional<Time> arrived_;  ///< when it was behind the door by its pose
  int blocked_ = 0;              ///< how often it was blocked in the door
  Stop stopped_by_;              ///< what stopped it in the door
  bool give_up_ = false;         ///< it does not try again
  bool stood_back_ = false;      ///< it has gone back to look
  bool at_hold_ = false;         ///< it waits at the hold point: a look from there is not like those before
  bool leaves_ = false;          ///< a cabin, without looks
  std::optional<int> came_by_;   ///< door of the plan that was passed last
  bool judge_ = false;           ///< enough looks have succeeded: the next pose is to be judged
};

}  // namespace priamos::planner
