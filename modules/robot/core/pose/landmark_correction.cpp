#include "robot/core/pose/landmark_correction.hpp"

namespace priamos::robot {

LandmarkCorrection CorrectionFrom(const Pose2& map_from_base, const Pose2& base_from_landmark,
                                  const Pose2& map_from_landmark) {
  const double rotation = WrapAngle(map_from_landmark.yaw - map_from_base.yaw - base_from_landmark.yaw);
  // Both positions relative to the estimated robot, axes of the map.
  const Eigen::Vector2d rec = map_from_base.rotation() * base_from_landmark.translation();
  const Eigen::Vector2d mod = map_from_landmark.translation() - map_from_base.translation();
  return {rotation, Pose2{0, 0, rotation} * rec - mod};
}

Pose2 Corrected(const Pose2& map_from_base, const LandmarkCorrection& correction) {
  return {map_from_base.x - correction.displacement_m.x(), map_from_base.y - correction.displacement_m.y(),
          WrapAngle(map_from_base.yaw + correction.rotation_rad)};
}

ExpectedMeasurement PredictMeasurement(const Pose2& map_from_base, const Pose2& map_from_landmark) {
  const Pose2 seen = map_from_base.Inverse() * map_from_landmark;
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Zero();
  by_pose.topLeftCorner<2, 2>() = -map_from_base.rotation().transpose();
  by_pose.topRightCorner<2, 1>() << seen.y, -seen.x;
  by_pose(2, 2) = -1;
  return {seen, by_pose};
}

}  // namespace priamos::robot
