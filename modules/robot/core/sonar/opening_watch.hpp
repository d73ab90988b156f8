#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/sonar/sonar_cycle.hpp"

namespace priamos::robot {

/// When things on both sides are an opening.
struct OpeningConfig {
  double near_m = 0.35;   ///< farther things on a side are no opening's
  double least_m = 0.15;  ///< the base drove at least so far from the first to the last near echoes

  void Describe(Archive& a);
};

/// A narrow place that the base drove through.
struct Opening {
  Time time{};          ///< when the middle of the base was in its middle
  Pose2 map_from_base;  ///< where the base believed to be then
  double width_m = 0;   ///< at most: sonars do not measure below 0.1 m
};

/// Evidence from outside that a door was passed: the sonars abeam heard something near on both sides at
/// once, the base drove on, and a side is free again (beside the other one a leaf may stand). Wheels alone
/// cannot bring that about.
class OpeningWatch {
 public:
  OpeningWatch(const OpeningConfig& config, const Footprint& footprint)
      : config_(config), footprint_(footprint) {}

  /// Takes a cycle of the sonars, with the poses at its end. Returns the opening that has just been left
  /// behind.
  std::optional<Opening> Add(const SonarCycle& cycle, const Pose2& odom_from_base,
                             const Pose2& map_from_base);

 private:
  struct Moment {
    Time time{};
    Pose2 odom_from_base, map_from_base;
  };
  std::optional<Opening> Left() const;

  OpeningConfig config_;
  Footprint footprint_;
  std::optional<Moment> first_, last_;  ///< first and last cycle with near things on both sides
  double width_m_ = 0;
  int free_cycles_ = 0;  ///< since the last near things on both sides
};

}  // namespace priamos::robot
