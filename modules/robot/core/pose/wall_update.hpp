#pragma once

#include <Eigen/Core>
#include <bitset>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "robot/core/pose/pose_state.hpp"
#include "robot/core/sonar/wall_fit.hpp"

namespace priamos::robot {

/// A straight wall of the state: its normal's angle in the map, pointing to the wall [rad], and its distance
/// from its anchor [m].
struct WallLine {
  double angle_rad = 0;
  double distance_m = 0;
  Eigen::Vector2d anchor{0, 0};

  Eigen::Vector2d normal() const;
};
WallLine WallOf(const PoseState& state, int wall);

/// The state with one wall more, correlated with the pose from which it was seen; the state must hold fewer
/// than kMostWalls.
PoseState WithWall(const PoseState& state, const WallSeen& seen);
/// The state without wall number `wall`; those behind it move up.
PoseState WithoutWall(const PoseState& state, int wall);
/// The wall of the state that `seen` shows again (nearer than 6 degrees and 15 cm to it), if there is one.
std::optional<int> SameWall(const PoseState& state, const WallSeen& seen);

/// The range of a sonar that heard something.
struct RangeSeen {
  Pose2 base_from_sonar;
  double range_m = 0;
  double sigma_m = 0.01;
};

/// The update of the state by the range of a wall.
struct RangeUpdate {
  PoseState state;
  double distance = 0;  ///< Mahalanobis distance of the range from what the state expects
};

/// Extended Kalman update by the perpendicular distance of a sonar from wall number `wall` (line features in
/// a joint state: Castellanos and Tardos, "Mobile Robot Localization and Map Building", 1999). The range's
/// error is its own: what looks repeat is carried along, not added to.
RangeUpdate Updated(const PoseState& prior, int wall, const RangeSeen& seen);

/// Which ranges count as those of a wall.
struct WallRangeConfig {
  double most_bearing_deg = 16;  ///< angle between a sonar's axis and the wall's normal
  double gate_distance = 3;      ///< Mahalanobis distance of the range from what is expected

  void Describe(Archive& a);
};

/// The state after all ranges of a cycle, and which of its walls were heard.
struct CycleUpdate {
  PoseState state;
  std::bitset<PoseState::kMostWalls> heard;
};

/// Updates the state by each range that is one of a wall: the nearest whose normal lies near the sonar's
/// axis.
CycleUpdate Updated(const PoseState& prior, const std::vector<RangeSeen>& ranges,
                    const WallRangeConfig& config);

}  // namespace priamos::robot
