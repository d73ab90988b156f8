#pragma once

#include <optional>
#include <string>

#include "common/archive.hpp"
#include "common/outcome.hpp"
#include "planner/core/missions/mission_control.hpp"
#include "planner/core/missions/mission_types.hpp"

namespace priamos::planner {

/// Limits that end any mission, and how patient it is with a path that the robot does not confirm.
struct MissionLimits {
  double resend_path_s = 4;  ///< [s] time after which a path the robot does not confirm is sent again
  double blocked_s = 8;      ///< [s] standing before an obstacle that stops the mission
  double silent_s = 8;       ///< [s] silence of the robot that ends the mission
  double limit_s = 120;      ///< [s] time for the whole mission

  void Describe(Archive& a);
};

/// One kind of mission: a pure state machine that sees the robot through a MissionControl. The frame around
/// it (MissionTable) starts it, calls Step() at every time step until it is done or has failed, ends it at
/// its limits or when it is aborted, and repeats its paths.
class Mission {
 public:
  virtual ~Mission() = default;

  /// Begins to carry out `order` and forgets what an earlier order left behind. Returns why the order cannot
  /// be carried out; nullopt when the mission is running.
  virtual std::optional<Refusal> Start(const MissionOrder& order) = 0;

  /// Decides one time step. The phase is kWaiting at first; the mission enters every other one itself, and
  /// ends with kDone or with MissionControl::Fail().
  virtual void Step(MissionControl& control) = 0;

  /// The robot stands and will not go on by itself: it touched something, or an obstacle has been before it
  /// for limits().blocked_s. The mission fails, unless it orders another path.
  virtual void OnStop(MissionControl& control, const Stop& stop) { control.Fail(stop.reason); }

  /// It was ended from outside: aborted, out of time, without news of the robot. What has to be put right is
  /// ordered now.
  virtual void OnEnded(MissionControl& /*control*/) {}

  virtual const MissionLimits& limits() const = 0;
  /// Reason when the time for the mission is over, e.g. "not through the door".
  virtual std::string Unfinished() const = 0;
};

}  // namespace priamos::planner
