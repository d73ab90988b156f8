#pragma once

#include <deque>
#include <optional>
#include <string>

#include "common/archive.hpp"
#include "planner/core/agenda/agenda_types.hpp"
#include "planner/core/missions/mission_table.hpp"
#include "planner/core/path/door_router.hpp"

namespace priamos::planner {

/// How long a robot is waited for, and what is added to distance over speed for the time left.
struct StepRunnerConfig {
  double pose_s = 8;        ///< without news of the robot before anything was driven: the step fails
  double blackout_s = 300;  ///< without news of it later: the step fails
  double leg_s = 3;         ///< to start, turn and stop on a drive
  double door_s = 5;        ///< for the looks at a door, and its evidence

  void Describe(Archive& a);
};

/// Carries out one step at a time with the missions of a table: finds the doors on the way to a place or to a
/// door, and has the mission of each leg carried out in turn.
class StepRunner {
 public:
  StepRunner(MissionTable& missions, DoorRouter& router, const AgendaKinds& kinds, const AgendaSpeeds& speeds,
             const StepRunnerConfig& config);

  void set_speeds(const AgendaSpeeds& speeds) { speeds_ = speeds; }
  /// Begins a step; nothing is sent before Tick(). `moved`: the robot has been driven for the same order.
  void Begin(const AgendaStep& step, Time now, bool moved);
  /// One time step. Returns what is to be sent.
  MissionActions Tick(Time now);
  /// Ends it without having done it: the robot brakes in the next time step.
  void End(const std::string& reason);
  /// Orders the robot to brake and hold although no step drives it.
  void Stand(Time now) { missions_.Stand(now); }
  void Pause(Time now);
  void Resume(Time now);

  bool running() const { return step_.has_value(); }
  /// Phase and words of the step that runs, or of how the last one ended.
  const MissionState& state() const { return state_; }
  /// Kind of the mission that state() is about; as the table has it.
  int kind() const { return missions_.kind(); }
  /// Expected time to the end of the step [s]; nullopt: not known.
  std::optional<double> Left_s(Time now) const;
  /// Expected time for a whole step from a place, and where the base is after it; nullopt: not known.
  struct Forecast {
    double takes_s = 0;
    Pose2 map_from_base;
  };
  std::optional<Forecast> Foresee(const AgendaStep& step, const Pose2& map_from_base);

 private:
  bool IsHeard(Time now) const;
  void StartLeg(Time now);
  void AwaitRobot(Time now);
  void Wait(Time now);
  void FollowLeg(Time now);
  Outcome<std::deque<Leg>> PlanLegs(const MissionOrder& order, const Pose2& from);
  MissionOrder OrderOf(const Leg& leg) const;
  double Takes_s(const Leg& leg) const;
  void Finish(Phase phase, std::string text);
  std::string Doors() const;
  std::string PausedText(Time now) const;

  MissionTable& missions_;
  DoorRouter& router_;
  AgendaKinds kinds_;
  AgendaSpeeds speeds_;
  StepRunnerConfig config_;

  std::optional<AgendaStep> step_;
  MissionState state_;
  std::optional<std::deque<Leg>> legs_;  ///< the first one is under way; nullopt: not planned
  bool under_way_ = false;               ///< the table carries out the first leg
  bool moved_ = false, paused_ = false;
  Time begun_{}, leg_begun_{}, last_tick_{};
  double waited_s_ = 0;             ///< of a step that waits
  double silence_s_ = 0;            ///< longest silence of the robot in this step
  std::vector<std::string> doors_;  ///< passed in this step
};

}  // namespace priamos::planner
