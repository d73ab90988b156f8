#pragma once

#include <Eigen/Core>
#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/sonar_ring.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/sonar/sonar_cycle.hpp"

namespace priamos::robot {

/// When near echoes are of something that closes in on the base.
struct ApproachConfig {
  double window_s = 0.5;    ///< echoes of so long decide
  double reach_m = 1.5;     ///< echoes from farther away tell nothing
  double least_m_s = 0.15;  ///< what comes more slowly counts as standing
  double quick_s = 0.3;     ///< who comes ...
  double quick_m_s = 0.6;   ///< ... faster than this crosses the beams, and is known by fewer echoes
  double slant = 0.7;     ///< and what comes by less than this part of the speed of the base across the beam
  double step_m = 0.25;   ///< a larger change from echo to echo is another thing
  double agree_m = 0.4;   ///< ranges of neighbours that hear one thing differ by less
  double body_m = 0.28;   ///< so far feet and shoulders reach beyond what the sonars hear of the legs
  double touch_m = 0.25;  ///< who has come and is heard nearer may touch with the trunk, above any bumper
  double near_m = 0.6;    ///< who has come and is heard nearer has not gone ...
  double wait_s = 4;      ///< ... and is waited for, for so long since he came
  double gone_s = 0.5;    ///< so long nothing closes in, and nothing is near: he has gone

  void Describe(Archive& a);
};

/// Finds what closes in on the base from any side in the last half second, without following it: a reflex
/// for who is too slow, or too far beside the heading, to be found as a mover (MoverWatch). The place of an
/// echo along the axis of its sensor, in the frame of the odometry, does not change for what stands, but for
/// the slant of a face over which the beam is carried, and where one thing ends before another. Neither
/// happens to two neighbouring sensors at once, and evenly. While the base stands only what moves closes in.
/// Remembered is by which sensor somebody came, until he has gone: legs that swing stand every other step,
/// and who stands close before the base touches it where it sets off.
class ApproachWatch {
 public:
  ApproachWatch(const ApproachConfig& config, const Footprint& footprint);

  /// Takes a cycle of the sonars. `odom_from_base`: pose when the cycle ended.
  void Add(const SonarCycle& cycle, const Pose2& odom_from_base);
  /// Whether something that closes in meets the footprint within `within_s`, body and all, or has come and
  /// stands before it. `velocity`: of the base, in its frame [m/s].
  bool Meets(const Eigen::Vector2d& velocity, double within_s) const;
  /// Whether something has come so near that it may touch the base where no bumper is.
  bool MayTouch() const;

 private:
  struct Sample {
    Time time{};
    Pose2 odom_from_sonar;
    double range_m = 0;
  };
  /// What one sensor heard over the window.
  struct Trend {
    double closing_m_s = 0;  ///< over the floor; 0 where it does not fall evenly
    double across_m_s = 0;   ///< of the place at that range before the sensor, across its axis
    double range_m = 0;      ///< newest
  };
  /// Something has come by a sensor.
  struct Comer {
    Time closed{}, heard{};  ///< when it closed in last, and when it did that or was near
    double closing_m_s = 0;
  };
  /// What two neighbours must hear over which time.
  struct Rule {
    double window_s = 0;
    std::size_t least_heard = 0;
    double least_m_s = 0, neighbour_m_s = 0;
  };
  using Trends = std::array<std::optional<Trend>, kSonars>;
  std::array<Rule, 2> Rules() const;
  std::optional<Trend> TrendOf(const std::deque<Sample>& samples, const Rule& rule) const;
  double SpeedOf(const std::vector<double>& falls, double lasts_s) const;
  bool Agrees(int sensor, const Trends& trends, const Rule& rule) const;
  std::optional<double> ClosingSpeed(int sensor) const;
  bool IsNearer(int sensor, double than_m) const;
  void Note(int sensor);
  bool Comes(int sensor, const Eigen::Vector2d& velocity, double within_s) const;
  double RangeOf(int sensor) const { return newest_.range_m[static_cast<std::size_t>(sensor)]; }

  ApproachConfig config_;
  Footprint footprint_;
  std::array<std::deque<Sample>, kSonars> heard_;
  std::array<Trends, 2> trends_;  ///< by the rules
  std::array<std::optional<Comer>, kSonars> comers_;
  SonarCycle newest_;
};

}  // namespace priamos::robot
