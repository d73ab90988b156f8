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
  double widen_m = 0.06;  ///< where both sides stay near, an opening ends when they are so much farther apart

  void Describe(Archive& a);
};

/// A narrow place that the base drove through.
struct Opening {
  Time time{};          ///< when the middle of the base was in its middle
  Pose2 map_from_base;  ///< where the base believed to be then
  double width_m = 0;   ///< at most: sonars do not measure below 0.1 m
};

/// Evidence from outside that a door was passed: the sonars abeam heard something near on both sides at
/// once, the base drove on, and a side is free again (beside the other one a leaf may stand), or both are
/// clearly farther apart (a cabin). Wheels alone cannot bring that about.
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
  /// Cycles in which both sides were near.
  struct Section {
    Moment first, last;
    double width_m = 0;  ///< least
  };
  std::optional<Opening> Left(const Section& section) const;
  std::optional<Opening> EndNarrowest(const Moment& now, double width_m);

  OpeningConfig config_;
  Footprint footprint_;
  std::optional<Section> near_;       ///< since a side was free
  std::optional<Section> narrowest_;  ///< of it
  int free_cycles_ = 0;               ///< since near_
  int wide_cycles_ = 0;               ///< since narrowest_
};

}  // namespace priamos::robot
