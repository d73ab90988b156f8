#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/body_size.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"

namespace priamos::robot {

/// A thing that the head saw, as SCENE_OBJECT tells it.
struct SeenThing {
  int id = 0;            ///< of the head
  Time seen{};           ///< exposure of the newest look that showed it
  bool is_edge = false;  ///< an upright edge only
  bool has_gone = false;
  Pose2 map_from_front;  ///< middle of its front; x square to it, into the thing
  double width_m = 0, depth_m = 0;
  double bottom_m = 0, top_m = 0;
  double sigma_m = 0;  ///< standard deviation of its place
};

/// Which of them the base keeps off.
struct HangingConfig {
  double low_m = 0.4;                   ///< what begins lower is heard by the sonars
  double high_m = kDrawnBody.height_m;  ///< what begins higher is above the robot
  double max_thickness_m = 0.12;        ///< a thicker thing is a face whose foot was not seen
  double max_sigma_m = 0.1;             ///< what is known worse is left to the planner
  double keep_s = 300;                  ///< after it was seen last
  double reach_m = 3;                   ///< farther from the base centre it does not matter yet

  void Describe(Archive& a);
};

/// Table tops, desks and boards that hang at the height of the base, where no sonar hears them: only the head
/// sees them, and from near not even the head. So they are kept where they were told, in the frame of the
/// odometry, until the head tells that they have gone, or for keep_s. Where the base itself stands nothing
/// hangs: that was a mistake.
class HangingMemory {
 public:
  HangingMemory(const HangingConfig& config, const Footprint& footprint)
      : config_(config), footprint_(footprint) {}

  /// Takes what the head tells. `odom_from_map`: as the base knows it now.
  void Take(const SeenThing& thing, const Pose2& odom_from_map);
  /// Forgets what is too old, and what the base stands in.
  void Forget(const Pose2& odom_from_base, Time now);
  /// Points on the outlines of those that are near, base frame [m].
  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const;

 private:
  struct Kept {
    Time seen{};
    std::vector<Eigen::Vector2d> in_odom;
  };
  bool Counts(const SeenThing& thing) const;

  HangingConfig config_;
  Footprint footprint_;
  std::map<int, Kept> things_;  ///< by their number
};

}  // namespace priamos::robot
