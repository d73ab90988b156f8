#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/base/odometry.hpp"
#include "robot/core/sonar/point_finder.hpp"
#include "robot/core/sonar/segment_finder.hpp"

namespace priamos::robot {

/// A straight piece of wall in the map, or, without length, a place that echoes to all sides.
struct Feature {
  int id = 0;
  Time seen{};
  Pose2 map_from_middle;  ///< x along it, with the wall to the right
  double length_m = 0;
  /// Of (place of the middle across it, positive to the left; direction) [m, rad].
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  double end_sigma_m = 0;
  bool gone = false;  ///< the sonars saw through it

  bool IsPoint() const { return length_m == 0; }
};

/// The base at one time, in both frames.
struct Whereabouts {
  Pose2 map_from_base;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, yaw) in the map
  Pose2 odom_from_base;
  double travel_m = 0;  ///< how far it had driven
};

/// A wall, or a point, as it was when it was heard last. A point is a piece without length of a wall that
/// faces the base from which it was found.
struct HeardFeature {
  SegmentLine line;  ///< frame of the odometry, as of `heard_at`
  Eigen::Vector2d from{0, 0}, to{0, 0};
  double end_sigma_m = 0;
  bool grows = true;
  Time heard{};
  Whereabouts heard_at;
};
HeardFeature HeardFeatureOf(const FoundSegment& found, const Whereabouts& heard_at);
HeardFeature HeardFeatureOf(const FoundPoint& found, const Whereabouts& heard_at);

/// It in the map, by the pose when it was heard or, when that tells more, by the pose now and the
/// odometry since then: a landmark fix mends what was heard before it.
Feature InMap(int id, const HeardFeature& heard, const Whereabouts& now, const OdometryNoise& noise);

}  // namespace priamos::robot
