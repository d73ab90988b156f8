#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/robot_drawing.hpp"
#include "common/time.hpp"
#include "robot/core/base/mecanum.hpp"

namespace priamos::robot {

/// One reading of the four encoders; order of the wheels as in WheelSpeeds.
struct WheelSample {
  Time time{};
  std::array<std::int32_t, 4> ticks{};
  bool deadline_stopped = false;  ///< the drive board holds the wheels because commands stayed away
};

/// Noise of the odometry over long distances, as random walks: the variance grows with the distance, sigma
/// with its root. Over short ones the slip of driving forward keeps its sign (OdometryWander).
struct OdometryNoise {
  double slip_length_m = 0.3;  ///< distance after which a wheel's slip is forgotten
  double forward_m_per_sqrt_m = 0.005;
  double sideways_m_per_sqrt_m = 0.006;  ///< along y when driving sideways
  double drift_m_per_sqrt_m = 0.005;     ///< across the driving direction
  double yaw_rad_per_sqrt_m = 0.0075;
  double yaw_rad_per_sqrt_rad = 0.0075;
  double slip_floor_m_s = 0.03;          ///< residual of the fourth equation that encoders alone explain
  double slip_variance_m2_per_m = 0.02;  ///< added variance per metre that wheels slipped against each other

  void Describe(Archive& a);
};

/// Resolution of the encoders, and how far odometry is trusted.
struct OdometryConfig {
  double ticks_per_turn = kDrawnWheels.ticks_per_turn;
  double unknown_speed_m_s = 0.5;  ///< speed assumed as sigma for a time without credible encoders
  OdometryNoise noise;

  void Describe(Archive& a);
};

/// What a step does to the slowly changing errors per metre forward: of the distance itself [m/m], of the
/// heading [rad/m] and across [m/m]. Each is a Gauss-Markov process over the distance (Gelb, "Applied Optimal
/// Estimation", 1974, section 3.6).
struct OdometryWander {
  double kept = 1;                                     ///< share of the errors that outlasts the step
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  ///< what the step adds to each

  /// Of a part of the step, `share` of its distance.
  OdometryWander Part(double share) const { return {std::pow(kept, share), variance * share}; }
};

/// Motion between two accepted samples: the body velocity was `twist` from `from` to `to`.
struct OdometryStep {
  Time from{}, to{};
  Twist2 twist{};
  double slip_m_s = 0;
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();  ///< covariance of the increment (x, y, yaw), base frame
  OdometryWander wander{};
  bool known = true;  ///< false: encoders were not credible, `twist` is 0 and `noise` covers the motion

  double seconds() const { return Seconds(to - from); }
  /// The step of wheels whose slip has `factor` times the variance. What is not their rolling is not less for
  /// that.
  OdometryStep Slipping(double factor) const;
};

/// Dead reckoning of the four wheels. Encoder counts may wrap; samples may be lost (the next one covers the
/// gap), double, late, or absurd: those are refused and counted. After two samples that agree with each other
/// but not with the past (a drive board that restarted), or 25 late ones in a row (a sender whose clock
/// stepped back), it goes on from the new counts and reports that the motion between is unknown; only then
/// can a step end before the one before it.
class Odometry {
 public:
  /// Counters of the samples so far.
  struct Counters {
    int accepted = 0;
    int doubles = 0;      ///< same time stamp as the last one
    int late = 0;         ///< older than the last one
    int from_future = 0;  ///< more than 0.1 s ahead of `now`
    int jumps = 0;        ///< a wheel would have turned faster than it can
    int restarts = 0;     ///< counts accepted anew
  };

  Odometry(const OdometryConfig& config, const MecanumGeometry& geometry)
      : config_(config), geometry_(geometry) {}

  /// Takes one sample; the step it completes, or nullopt for the first and for refused ones.
  std::optional<OdometryStep> Add(const WheelSample& sample, Time now);

  /// Pose of the base in the odometry frame, its pose at the first sample.
  const Pose2& pose() const { return pose_; }
  /// Velocity and slip of the last step; 0 before the second sample.
  const Twist2& twist() const { return twist_; }
  double slip_m_s() const { return slip_m_s_; }
  /// Time of the newest accepted sample; nullopt before the first.
  std::optional<Time> time() const;
  const Counters& counters() const { return counters_; }

 private:
  bool IsPlausible(const WheelSample& from, const WheelSample& to) const;
  bool RefusedByTime(const WheelSample& sample, Time now);
  OdometryStep KnownStep(const WheelSample& to) const;
  OdometryStep UnknownStep(const WheelSample& to, Time from, Duration span) const;
  Eigen::Matrix3d Noise(const Twist2& twist, double slip_m_s, double seconds) const;
  OdometryWander Wander(const Twist2& twist, double seconds) const;
  OdometryStep Accept(const OdometryStep& step, const WheelSample& sample);

  OdometryConfig config_;
  MecanumGeometry geometry_;
  std::optional<WheelSample> last_;
  std::optional<WheelSample> candidate_;  ///< implausible against last_; a second one like it is believed
  int late_in_a_row_ = 0;
  Pose2 pose_;
  Twist2 twist_;
  double slip_m_s_ = 0;
  Counters counters_;
};

}  // namespace priamos::robot
