#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/missions/look_sequence.hpp"
#include "planner/core/missions/mission_control.hpp"

namespace priamos::planner {

/// When a correction of the pose is asked for, and from where a door can be seen.
struct PoseKeeperConfig {
  double sigma_m = 0.08;         ///< asked for above this standard deviation of the position
  double nearest_m = 1.2;        ///< distance to the door ...
  double farthest_m = 3.4;       ///< ... at which it is looked at
  double most_slant_deg = 65;    ///< angle between its axis and the line to the robot
  double most_bearing_deg = 95;  ///< angle between the base's heading and the line to the door
  double pause_s = 10;           ///< after looks that failed
  double teach_m = 8;            ///< distance to doors ahead of which the head is sent a model

  void Describe(Archive& a);
};

/// Keeps the pose known on any drive (paper, section 3.2): while it is uncertain the head is asked to look,
/// in passing, at the nearest door that is well in sight.
class PoseKeeper {
 public:
  PoseKeeper(const PoseKeeperConfig& config, const GroundPlan& plan);

  void Reset();
  /// Whether looks that are due, or soon will be, may yet make the pose better known where the robot is.
  bool MayHelp(const MissionControl& control) const;
  /// Whether the pose is uncertain where no door is in sight: walls of the plan may help there.
  bool NeedsWalls(const MissionControl& control) const;
  /// One time step: takes the answers to looks, and asks for the next one when it is needed.
  void Step(MissionControl& control);

  /// The door to look at from a pose, from its front or from behind (FromBehind()); nullptr when none is in
  /// sight.
  const DoorPlan* DoorInSight(const Pose2& map_from_base) const;

 private:
  bool IsNeeded(const MissionControl& control) const;
  void Teach(MissionControl& control);
  void Forgot(int door_id);
  const DoorPlan* NearestUntaught(const Pose2& map_from_base) const;

  PoseKeeperConfig config_;
  GroundPlan plan_;
  std::vector<DoorPlan> doors_;  ///< from either side
  LookSequence looks_;
  const DoorPlan* door_ = nullptr;  ///< looked at last
  std::optional<Time> gave_up_;
  std::map<int, Time> taught_;  ///< when the head was sent the model of a door
  Time next_lesson_{};
};

}  // namespace priamos::planner
