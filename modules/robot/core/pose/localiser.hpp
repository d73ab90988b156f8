#pragma once

#include <string>
#include <utility>
#include <vector>

#include "robot/core/base/odometry.hpp"
#include "robot/core/pose/pose_estimator.hpp"
#include "robot/core/sonar/wall_finder.hpp"

namespace priamos::robot {

/// Odometry, pose filter, walls beside the way, and how long a fix may wait.
struct LocaliserConfig {
  OdometryConfig odometry;
  PoseEstimatorConfig estimator;
  WallFinderConfig walls;
  double fix_wait_s = 0.5;  ///< how long a fix waits for odometry of its picture's time

  void Describe(Archive& a);
};

/// Odometry and pose estimator together, and the fixes that wait because their picture is newer than the
/// newest odometry.
class Localiser {
 public:
  /// A fix and what became of it.
  struct Answer {
    LandmarkFix fix;
    FixResult result;
  };

  Localiser(const LocaliserConfig& config, const MecanumGeometry& geometry, const Footprint& footprint);

  /// Takes a sample of the wheels; returns false when it was refused (see Odometry::counters).
  bool AddWheels(const WheelSample& sample, Time now);
  /// The base slipped by up to so much without the encoders knowing, one sigma: the next step of the odometry
  /// carries it.
  void AddSlip(double position_m, double yaw_rad);
  void AddFix(const LandmarkFix& fix, Time now);
  /// Sets the pose as it is now, and forgets the fixes that wait. Returns the change.
  Pose2 Reset(const KnownPose& known);
  /// Takes a cycle of the sonars: ranges of straight walls hold the pose, their heading above all.
  void AddSonar(const SonarCycle& cycle);
  /// Sets the walls of the plan by which the pose is corrected; none: it is not.
  void SetPlan(std::vector<PlanWall> plan) { estimator_.SetPlan(std::move(plan)); }
  /// Applies the fixes that can be applied. Returns one answer per fix that no longer waits.
  std::vector<Answer> Step(Time now);

  const Odometry& odometry() const { return odometry_; }
  /// The base in the odometry frame at a time that has passed, for instance that of an exposure: back from
  /// the newest sample with its velocity, 5 s at most. The newest pose for a time after it.
  Pose2 OdometryPoseAt(Time time) const;
  /// How often a wall was found to be one of the plan.
  int plan_matches() const { return estimator_.plan_matches(); }
  std::optional<PoseEstimate> estimate() const { return estimator_.newest(); }

 private:
  struct Waiting {
    LandmarkFix fix;
    Time received;
  };

  LocaliserConfig config_;
  Odometry odometry_;
  PoseEstimator estimator_;
  WallFinder walls_;
  std::array<Pose2, kSonars> base_from_sonar_;
  std::vector<Waiting> waiting_;
  Eigen::Matrix3d slipped_ = Eigen::Matrix3d::Zero();  ///< added to the noise of the next step
};

}  // namespace priamos::robot
