#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "planner/core/agenda/agenda_types.hpp"
#include "planner/core/agenda/step_runner.hpp"

namespace priamos::planner {

/// The orders of the people at the workstation: one is carried out, the others wait in their order. Each has
/// steps, done in turn and in rounds. An order that fails cancels those that wait, since they were given in
/// the belief that it would succeed; an emergency stop ends all, whether it comes during a mission or between
/// two. Time is an argument; everything that is sent comes from Tick().
class Agenda {
 public:
  /// More orders do not wait.
  static constexpr std::size_t kMostWaiting = 8;
  /// So many ends are remembered.
  static constexpr std::size_t kMostResults = 32;
  static constexpr std::size_t kMostSteps = 32;

  Agenda(MissionTable& missions, DoorRouter& router, const AgendaKinds& kinds, const AgendaSpeeds& speeds,
         const StepRunnerConfig& config);

  /// Changes the speeds with which it reckons.
  void set_speeds(const AgendaSpeeds& speeds) { runner_.set_speeds(speeds); }
  /// Takes an order; one with the number of an order that is known is that one, said again. A refusal is
  /// among the results, too.
  std::optional<Refusal> Take(AgendaOrder order, Time now);
  /// Ends what is under way, and cancels what waits. The robot is ordered to stand in any case: it may follow
  /// a path of an earlier planner process. With an id, of the order to abort, that is answered among the
  /// results.
  void Abort(Time now, int id = 0);
  /// Ends or cancels one order. False: none of this number is under way or waits.
  bool Cancel(int order_id);
  /// Has the robot hold its place until Resume(). False: nothing is under way.
  bool Pause(Time now);
  bool Resume(Time now);

  /// One time step. Returns what is to be sent.
  MissionActions Tick(Time now);

  bool running() const { return current_.has_value(); }
  bool paused() const { return paused_; }
  /// Phase and words of the order under way, else of how the last one ended.
  const MissionState& state() const { return state_; }
  int kind() const { return runner_.kind(); }
  /// The order under way, else the last one; without steps before the first.
  const AgendaOrder& order() const { return current_ ? current_->order : last_; }
  int step() const { return step_; }    ///< from 1 on
  int round() const { return round_; }  ///< from 1 on
  /// Expected time to the end of the round [s]; nullopt: not known.
  std::optional<double> Left_s(Time now) const;
  std::vector<AgendaOrder> waiting() const;
  /// How the last steps and orders ended, the newest one last.
  const std::deque<AgendaResult>& results() const { return results_; }
  /// How many ends there were, of which results() are the newest.
  std::size_t n_ended() const { return n_ended_; }
  /// Counts whatever a person should be shown at once, beside changes of state().
  std::size_t changes() const { return changes_; }

  /// A step in words: "goto (4.70, 1.30)", "door 'laboratory'", "wait 5 s".
  std::string TitleOf(const AgendaStep& step) const;

 private:
  /// An order, and the emergency stops since it was given.
  struct Given {
    AgendaOrder order;
    EstopWatch estop;
    Time given{}, begun{};
  };

  static bool IsPlace(const Pose2& pose);
  std::optional<Refusal> Check(const AgendaOrder& order) const;
  bool IsKnown(int id) const;
  int FreeId();
  void BeginNext(Time now);
  void BeginStep(Time now);
  void EndStep(Time now);
  void EndOrder(AgendaEnd end, std::string text, Time now);
  void CancelWaiting(const std::string& why);
  void CheckEstop();
  void Remember(AgendaResult result);
  void Foresee();

  MissionTable& missions_;
  DoorRouter& router_;
  AgendaKinds kinds_;
  StepRunner runner_;

  std::optional<Given> current_;
  std::deque<Given> waiting_;
  AgendaOrder last_;
  std::deque<AgendaResult> results_;
  MissionState state_;
  int step_ = 0, round_ = 0;
  bool paused_ = false;
  std::size_t changes_ = 0, n_ended_ = 0;
  std::optional<AgendaEnd> ending_;  ///< how the order under way is being ended by a person
  Time step_begun_{};
  int last_id_ = 0;
  /// How long each step takes, as far as it is known, and the place after the last known one.
  std::vector<std::optional<double>> takes_s_;
  std::optional<Pose2> foreseen_;
  std::size_t n_foreseen_ = 0;
};

}  // namespace priamos::planner
