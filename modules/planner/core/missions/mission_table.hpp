#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "planner/core/missions/lost_watch.hpp"
#include "planner/core/missions/mission.hpp"

namespace priamos::planner {

/// The missions by the kind of their order, of which one at a time is carried out. Time is an argument,
/// messages are stored by On...(), everything is decided in Tick(). Before the first order nothing is
/// sent. The end of a mission is DONE, or FAILED with a sentence, and then the robot has been ordered to
/// brake.
class MissionTable {
 public:
  /// Adds a mission; `kind` identifies it in an order. The first one added is shown before the first order.
  void Add(int kind, std::unique_ptr<Mission> mission);
  /// nullptr when there is none of this kind.
  Mission* Find(int kind) const { return Knows(kind) ? missions_.at(kind).get() : nullptr; }
  bool Knows(int kind) const { return missions_.contains(kind); }

  /// Begins a known mission; refused (false) while one is being carried out. A mission that cannot carry out
  /// the order has failed at once.
  bool Start(Time now, const MissionOrder& order);
  /// Ends the mission under way in the next time step, with this reason.
  void Abort(std::string reason = "aborted by the operator");
  /// Orders the robot to brake and hold although no mission is under way: it may follow a path of an earlier
  /// planner process. Repeated until the robot confirms it.
  void Stand(Time now);
  /// Has the robot brake and hold wherever it is, until Resume(); then it goes on with what is left of its
  /// path, and the mission with what it was doing. Time limits do not count meanwhile. The emergency stop
  /// ends a held mission as well.
  void Pause(Time now);
  void Resume(Time now);
  bool paused() const { return paused_since_.has_value(); }
  /// Whether the robot reports about the path, or order to stand, that was sent last.
  bool IsConfirmed() const { return control_.OnPath(); }

  /// A mission whose robot falls silent when it is under way ends after `seconds`, or after its own silent_s
  /// if that is longer: meanwhile the robot drives as far as its path leads, and the mission goes on when it
  /// is heard again. Time limits do not count meanwhile. Without a call, silent_s ends it.
  void TolerateSilence(double seconds) { blackout_s_ = seconds; }
  /// How long the robot of the mission under way has been silent, when that is longer than its silent_s.
  std::optional<double> Silence_s(Time now) const;

  void OnPose(const RobotPose& pose);
  void OnDrive(const DriveReport& told, Time now);
  void OnLook(const LookResult& result) {
    control_.NotePlaced(result);
    lost_.Note(result);
    control_.heard_.looks.push_back(result);
  }
  /// What contradicts the robot's pose; nullopt: nothing does.
  std::optional<std::string> WhyLost() const { return lost_.Why(control_.heard().pose); }
  void OnTold(const SeenFeature& seen) { control_.heard_.told.push_back(seen); }
  /// Notes that the robot's pose was corrected at `stamp`: older poses are not used for planning any more.
  void OnCorrected(Time stamp);
  void OnLeaf(const LeafSighting& leaf) { control_.heard_.leaves.push_back(leaf); }
  void OnOpening(const PassedOpening& opening) { control_.heard_.opening = opening; }
  void OnLearned(std::shared_ptr<const LearnedWalls> walls) { control_.heard_.learned = std::move(walls); }
  void OnLink(bool up) { control_.heard_.link_up = up; }

  /// One time step of the mission under way. Returns what is to be sent.
  MissionActions Tick(Time now);

  const Heard& heard() const { return control_.heard(); }
  const MissionState& state() const { return control_.state(); }
  bool running() const { return control_.running(); }
  /// Kind of the mission that state() is about.
  int kind() const { return kind_; }

 private:
  void Step(Mission& mission);
  void Decide(Mission& mission);
  std::optional<std::string> ReasonToEnd(const Mission& mission) const;
  std::optional<Stop> StopOf(const Mission& mission);
  void NoteTouch(const DriveReport& drive);
  bool StoodTooLong(const Mission& mission) const;
  double ResendAfter_s() const;
  double SilentFor_s(Time now) const;
  std::optional<std::string> WhySilenceEnds(const Mission& mission) const;

  std::map<int, std::unique_ptr<Mission>> missions_;
  MissionControl control_;
  LostWatch lost_;
  int kind_ = 0;
  std::optional<std::string> aborted_;  ///< the reason
  std::optional<Time> blocked_since_, paused_since_;
  bool touched_ = false;             ///< reported, and the mission does not know yet
  std::optional<int> touched_path_;  ///< the path on which it was
  double blackout_s_ = 0;
  Time last_tick_{};
  Duration idle_{};  ///< of the mission's time: paused, or without news of the robot
};

}  // namespace priamos::planner
