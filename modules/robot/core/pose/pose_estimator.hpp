#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/base/odometry.hpp"
#include "robot/core/pose/landmark_update.hpp"
#include "robot/core/pose/plan_match.hpp"
#include "robot/core/pose/slip_scale.hpp"
#include "robot/core/pose/wall_update.hpp"

namespace priamos::robot {

/// Pose at the start as configured, map frame. The errors are bounds; inside them nothing is known, so the
/// estimator starts with bound / sqrt(3), the standard deviation of a uniform distribution.
struct InitialPose {
  double x_m = 0, y_m = 0, yaw_deg = 0;
  double position_error_m = 0.20;
  double yaw_error_deg = 5;

  void Describe(Archive& a);
};

/// First pose, bias of odometry, and which fixes are believed.
struct PoseEstimatorConfig {
  InitialPose initial;
  OdometryBias bias;
  double history_s = 10;
  double gate_distance =
      4.0;  ///< Mahalanobis gate, 3 degrees of freedom: a true fix lies beyond 4.0 once in 900
  double least_fix_sigma_m =
      0.0003;  ///< least sigma of a fix: 1 ms at 0.3 m/s, the error of the picture's time
  double least_fix_sigma_deg = 0.01;
  WallRangeConfig walls;
  PlanMatchConfig plan;

  void Describe(Archive& a);
};

/// A pose that somebody knows, map frame, and how well.
struct KnownPose {
  Pose2 map_from_base;
  double sigma_m = 0.1;  ///< of x and of y
  double sigma_yaw_rad = 0.05;
};

/// What the ring heard in one cycle: ranges of walls, and the walls as the last ranges show them.
struct RingHeard {
  Time time{};
  std::vector<RangeSeen> ranges;
  std::vector<WallSeen> walls;  ///< frame of the base at `time`
};

/// A landmark as the head reconstructed it from one stereo pair.
struct LandmarkFix {
  Time exposure{};
  int request_id = 0;
  Pose2 base_from_landmark;                                  ///< X_rec
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< covariance of X_rec (x, y, yaw) [m, rad]
  Pose2 map_from_landmark;                                   ///< X_mod
  double own_share = 1;  ///< share of the covariance that is independent of other looks
};

/// The pose at one time, map frame; covariance of (x, y, yaw) in m and rad.
struct PoseEstimate {
  Time time{};
  Pose2 pose;    ///< map_from_base
  Twist2 twist;  ///< base frame
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  double PositionSigma() const;  ///< root of the larger eigenvalue of the position's covariance [m]
  double YawSigma() const;
};

/// Whether a fix was applied, or why not; kDouble: this picture has been used already.
enum class FixVerdict { kApplied, kTooOld, kTooNew, kImplausible, kDouble };

/// What became of a fix.
struct FixResult {
  FixVerdict verdict = FixVerdict::kImplausible;
  Pose2 change;  ///< correction of the pose at the time of the picture, map frame; also of a refused fix
  double distance = 0;      ///< Mahalanobis distance, 3 degrees of freedom; 0 if it was not computed
  PoseEstimate at_picture;  ///< the estimate for the time of the picture, after the fix if it was applied
  std::string reason;       ///< why not applied, with numbers
};

/// The pose in the map. Odometry carries it; a fix corrects it *at the time of its picture* and everything
/// driven since is carried forward from there. So a fix may be seconds old, and two fixes may come in either
/// order with the same result. Errors that several looks share do not average out. Fixes that contradict
/// estimate and covariance are refused: one wrong door must not move the robot. Unless the fix is far off,
/// wheels that slip more than was known may be what is wrong: then it is judged by what they add since the
/// fix before it once more, with all that is known of them by now.
class PoseEstimator {
 public:
  explicit PoseEstimator(const PoseEstimatorConfig& config);

  void Move(const OdometryStep& step);

  /// Sets the pose as it is now. What was learnt of the wheels stays; walls, and fixes of pictures from
  /// before, do not count any more. Returns the change.
  Pose2 Reset(const KnownPose& known);

  /// Applies a fix and returns what became of it. kTooNew: taken after the newest odometry; give it again
  /// when odometry has got there.
  FixResult Apply(const LandmarkFix& fix);

  /// Corrects the pose by the ranges of walls that it knows, and takes up walls that it does not.
  void Hear(const RingHeard& heard);
  /// Sets the walls of the plan around the base; what the ring hears of them corrects the pose.
  void SetPlan(std::vector<PlanWall> plan) { plan_ = std::move(plan); }
  /// How many times the configured variance the slip of the wheels has, as fixes told so far.
  double slip_factor() const { return slip_factor_; }
  /// How often a wall was found to be one of the plan.
  int plan_matches() const { return plan_matches_; }
  /// How many straight walls hold the pose now.
  int walls() const { return history_.empty() ? 0 : history_.back().state.walls(); }

  /// The estimate at the time of the newest odometry; nullopt before the first step.
  std::optional<PoseEstimate> newest() const;

 private:
  struct Entry {
    OdometryStep step;                 ///< odometry step to this entry, its noise as configured
    PoseState state{};                 ///< after step, ranges, changes of walls, and fix
    double slip = 1;                   ///< factor of the variance of the wheels' slip in the step
    std::optional<LandmarkFix> fix{};  ///< the fix that was applied at this entry
    std::vector<RangeSeen> ranges{};   ///< what the ring heard at this entry
    std::optional<int> lost{};         ///< the wall that was given up before these ranges
    std::optional<WallSeen> found{};   ///< the wall that was taken up then
    std::vector<PlanMatch> matches{};  ///< walls that were found to be the plan's then
  };

  std::optional<FixResult> RefuseByForm(const LandmarkFix& fix) const;
  LandmarkMeasurement MeasurementOf(const LandmarkFix& fix) const;
  std::size_t EntryAt(Time time);
  void Replay(std::size_t from);
  /// Whether the heading of a fix is known so well that it tells what the wheels missed.
  static bool TellsSlip(const LandmarkFix& fix);
  void LearnSlip(std::size_t index, const LandmarkFix& fix, double distance);
  bool Doubt(std::size_t index);
  /// Puts a fix and the state after it at an entry; the entry at which it is.
  std::size_t Insert(std::size_t index, const PoseState& state, const LandmarkFix& fix);
  void ComparePlan(std::size_t index);
  void DropSilent(Entry& entry);
  void Lose(int wall, Entry& entry);
  void TakeUp(const PoseState& state, const WallSeen& seen, Entry& entry);
  PoseEstimate EstimateAt(const Entry& entry) const;
  void Forget();

  PoseEstimatorConfig config_;
  PoseState initial_;
  std::deque<Entry> history_;  ///< ascending in time; front() is where replay may start
  std::vector<Time> heard_;    ///< when each wall of the newest state was heard last
  Time newest_cycle_{};
  std::vector<PlanWall> plan_;
  std::optional<Time> compared_;  ///< when the walls were compared with the plan last
  int plan_matches_ = 0;
  SlipScale slip_;
  double slip_factor_ = 1;             ///< of slip_
  std::optional<LandmarkFix> learnt_;  ///< the last fix that told slip_ something
};

}  // namespace priamos::robot
