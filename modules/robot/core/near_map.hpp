#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"

namespace priamos::robot {

struct NearMapConfig {
  double keep_m = 0.5;  ///< only echoes this near are kept: farther away an arc is too wide to be a place
  double keep_s = 5;
  double forget_m = 2.0;   ///< things this far from the base centre are forgotten
  double through_deg = 5;  ///< a thing this near to the axis of a beam that sees on behind it is gone

  void Describe(Archive& a);
};

/// Where near things were, frame of the odometry, in cells of 4 cm. The beams of 24 sensors on a rectangle
/// leave gaps close to the base: a chair leg that a beam has seen disappears between two of them when the
/// base comes nearer, but is still there. A thing is kept for some seconds, or until a beam sees through it.
class NearMap {
 public:
  explicit NearMap(const NearMapConfig& config) : config_(config) {}

  /// A believed echo at `range_m` of a sensor at `odom_from_sonar`.
  void Add(const Pose2& odom_from_sonar, double range_m, Time now);
  /// The same echo clears what lies well before it.
  void Clear(const Pose2& odom_from_sonar, double range_m);
  void Forget(const Pose2& odom_from_base, Time now);

  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const;

 private:
  using Cell = std::pair<int, int>;
  struct Thing {
    Eigen::Vector2d in_odom{0, 0};
    Time seen{};
  };

  NearMapConfig config_;
  std::map<Cell, Thing> things_;
};

}  // namespace priamos::robot
