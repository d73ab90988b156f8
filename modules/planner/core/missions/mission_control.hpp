#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/learned/learned_walls.hpp"
#include "common/time.hpp"
#include "planner/core/missions/estop_watch.hpp"
#include "planner/core/missions/mission_types.hpp"
#include "planner/core/path/planned_path.hpp"

namespace priamos::planner {

/// State of the robot as the planner knows it at a time step. All stamps are in the planner's clock.
struct Heard {
  bool link_up = false;
  std::optional<RobotPose> pose;         ///< newest
  std::optional<DriveReport> drive;      ///< newest
  std::optional<Time> corrected;         ///< stamp of the newest pose correction since the mission's start
  std::optional<PassedOpening> opening;  ///< newest since the mission's start
  std::vector<LeafSighting> leaves;      ///< leaves of doors seen since the last time step, in order
  std::shared_ptr<const LearnedWalls> learned;  ///< walls that robots found; another object when they change
  std::vector<LookResult> looks;                ///< answers to looks since the last time step, in order
  std::vector<SeenFeature> told;  ///< features that the robot told of since the last time step, in order
};

/// A mission's view of the robot: its state, and the orders and the state that leave in this time
/// step. Numbers of paths and looks go on over all missions, so that an answer meant for an earlier order is
/// not taken for one to the present order.
class MissionControl {
 public:
  Time now() const { return now_; }
  Time started() const { return started_; }
  const Heard& heard() const { return heard_; }

  /// Shows `phase`, and `text` as its description or, at the end, as the outcome's reason.
  void Enter(Phase phase, std::string text) { state_ = {phase, std::move(text)}; }
  /// Ends the mission: the robot brakes, and whatever else was ordered in this time step is dropped.
  void Fail(std::string reason);
  const MissionState& state() const { return state_; }
  /// Whether a mission is under way: started, neither done nor failed.
  bool running() const { return running_ && state_.phase != Phase::kDone && state_.phase != Phase::kFailed; }

  /// Orders a path at `speed_m_s`; it is sent again until the robot confirms it.
  void OrderPath(PlannedPath path, double speed_m_s);
  /// The path ordered last, and when it was sent last (none: not in this mission).
  const PathOrder& path() const { return path_; }
  const std::optional<Time>& path_sent() const { return path_sent_; }
  /// Whether the robot reports about the path ordered last.
  bool OnPath() const { return heard_.drive && heard_.drive->path_id == path_.path_id; }
  /// Whether a path was ordered since the mission's start: the newest, or one that the robot still reports
  /// of.
  bool IsOwn(int path_id) const { return path_ids_.contains(path_id); }

  /// Orders a look of the head at a side of a landmark. Returns the number that its answer will carry.
  int OrderLook(int landmark_id, Side side);
  /// Has the robot brake and tells it where it is; said again until it obeys, also when the mission is over
  /// by then, five times at most.
  void OrderPlace(const Pose2& map_from_base, double sigma_m, double sigma_yaw_rad);
  /// Whether an order about its place is still to be obeyed.
  bool IsPlacing() const { return place_.has_value(); }
  /// Whether the newest such order was given up.
  bool place_refused() const { return place_refused_; }
  /// Sends the walls of the plan along the way, unless the robot has just these.
  void SendFaces(std::vector<WallFace> faces);
  /// The map that was made so far takes the place of what the planner has learned.
  void SendMap(LearnedWalls walls) { actions_.map = std::move(walls); }
  /// Sends a landmark's model to the head.
  void SendModel(Landmark model) { actions_.model = std::move(model); }

 private:
  friend class MissionTable;
  void Begin(Time now);
  void NoteDrive(const DriveReport& drive);
  /// Orders the robot to brake and hold, whatever it drives, also when none of its paths is known here.
  void Stand(Time now);
  /// Sends an order to stand that was given outside of a mission again, while the robot is heard and does not
  /// confirm it; kMostRepeats times.
  void RepeatUnconfirmedStand(Time now, double after_s);
  /// Has the robot brake, to go on with what is left of its path on GoOn().
  void Hold();
  void GoOn();
  void SendPath();
  void NumberFrom(Time now);
  void RepeatUnconfirmedPath(double after_s);
  void RepeatFaces();
  void RepeatPlace();
  void NotePlaced(const LookResult& result);
  int NextNumber();

  Heard heard_;
  Time now_{}, started_{};
  bool running_ = false;
  MissionState state_;
  MissionActions actions_;
  PathOrder path_;
  std::optional<Time> path_sent_;
  std::set<int> path_ids_;  ///< of the paths ordered since the mission's start
  int n_stand_repeats_ = 0;
  std::optional<PlaceOrder> place_;  ///< that the robot has not obeyed yet
  Time place_sent_{};
  int n_place_repeats_ = 0;
  bool place_refused_ = false;
  std::vector<WallFace> faces_;  ///< that the robot is to have
  std::optional<Time> faces_sent_;
  bool faces_are_own_ = false;  ///< this mission has said which
  Pose2 path_start_;            ///< where the robot was when path_ was ordered
  double remaining_m_ = 0;      ///< of path_, as reported last
  /// The path to go on with, and the same of it.
  struct Held {
    PathOrder path;
    Pose2 start;
    double remaining_m = 0;
  };
  std::optional<Held> held_;
  EstopWatch estop_;
  int last_number_ = 0;
};

}  // namespace priamos::planner
