#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/core/missions/mission_control.hpp"
#include "planner/core/path/footprint.hpp"

namespace priamos::planner {

/// The points of a path that a base still has before it when it has `remaining_m` to go.
std::vector<Pose2> PointsLeft(const std::vector<Pose2>& points, double remaining_m);

/// Whether the base has come to the end of the path ordered last, and has told where that is.
bool HasArrived(const MissionControl& control);

/// The thing that stops the base, map frame, of `size_m`, because one side of it is known only; see
/// ThingMet(). nullopt: the path has no direction.
std::optional<Rectangle> ThingAhead(const MissionControl& control, const Footprint& footprint, double size_m);

/// The thing that a base meets first that drives `ahead`, map frame and of length 1. Its near side is where
/// the robot heard it, across that direction; nothing heard: before the footprint. What is met with a corner
/// of the base, the jamb of an opening for instance, reaches from there outwards.
Rectangle ThingMet(const Pose2& base, const Eigen::Vector2d& ahead, const std::optional<ThingNear>& nearest,
                   const Footprint& footprint, double size_m);

/// A hold, of a robot that does not know where it is for instance, may end by itself, but is not waited for
/// for ever. Time without news of the robot does not count.
class StandWatch {
 public:
  /// Which times count: those in which something holds the robot, or those in which nothing does, or only
  /// what it hears: before a thing it need not say that it is blocked.
  enum class Counts { kHeld, kFree };
  explicit StandWatch(Counts counts = Counts::kHeld) : counts_(counts) {}

  void Reset() { *this = StandWatch(counts_); }
  /// One time step of a robot on its path. Returns how long it has come no further [s].
  double Stands_s(const MissionControl& control);

 private:
  Counts counts_;
  double stood_s_ = 0, stood_at_m_ = 0;  ///< how long without progress, and what was left then
  double stood_at_rad_ = 0;              ///< and the heading: a base that turns slowly gets on, too
  std::optional<Time> stepped_;
};

/// A robot that comes no further on its path: held by something that may end by itself, or by nothing.
class ProgressWatch {
 public:
  void Reset() { *this = {}; }
  /// Forgets for how long nothing has held it.
  void ResetIdle() { idles_.Reset(); }
  /// One time step of a robot on its path. What holds it is said after some seconds; one that has been held
  /// for `held_s` has the mission fail; one that has come no further for `idle_s` though nothing holds it is
  /// blocked, which is returned.
  std::optional<Stop> Step(MissionControl& control, double held_s, double idle_s);

 private:
  void SayWhatHolds(MissionControl& control, double held_s);

  StandWatch holds_, idles_{StandWatch::Counts::kFree};
  /// What the mission says while something holds the robot, and said before.
  struct Said {
    std::string before, now;
  };
  std::optional<Said> said_;
};

}  // namespace priamos::planner
