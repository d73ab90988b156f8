#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// What is remembered, and when it is forgotten.
struct NearMapConfig {
  double keep_m = 0.5;  ///< only echoes this near are kept: farther away an arc is too wide to be a place
  double keep_s = 5;    ///< while the base moves
  double keep_standing_s = 30;  ///< while it stands and has no path to follow
  double forget_m = 2.0;        ///< things this far from the base centre are forgotten
  double through_deg = 5;       ///< a thing this near to the axis of a beam that sees on behind it is gone

  void Describe(Archive& a);
};

/// Where near things were, frame of the odometry, in cells of 4 cm. The beams of 24 sensors on a rectangle
/// leave gaps close to the base: a chair leg that a beam has seen disappears between two of them when the
/// base comes nearer, but is still there. A thing is kept for some seconds, or until a beam sees through it;
/// longer beside a base that stands, which has no other way to know of it when it drives off.
class NearMap {
 public:
  explicit NearMap(const NearMapConfig& config) : config_(config) {}

  /// A believed echo at `range_m` of a sensor at `odom_from_sonar`.
  void Add(const Pose2& odom_from_sonar, double range_m);
  /// Removes the points that lie well before an echo at `range_m` [m], near the axis of its sensor.
  void Clear(const Pose2& odom_from_sonar, double range_m);
  /// Advances time to `now` and forgets what is too old; call it often. `waits`: the base stands before an
  /// obstacle that blocks its path, so that standing does not keep points for longer.
  void Forget(const Pose2& odom_from_base, Time now, bool waits = false);

  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const;

 private:
  using Cell = std::pair<int, int>;
  struct Thing {
    Eigen::Vector2d in_odom{0, 0};
    double seen_s = 0;  ///< by clock_s_
  };
  bool Stands(const Pose2& odom_from_base, double dt_s) const;

  NearMapConfig config_;
  std::map<Cell, Thing> things_;
  double clock_s_ = 0;  ///< goes slower while the base stands
  std::optional<Time> now_;
  Pose2 here_;
};

}  // namespace priamos::robot
