#pragma once

#include <array>
#include <deque>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/sonar/sonar_cycle.hpp"
#include "robot/core/sonar/wall_fit.hpp"

namespace priamos::robot {

/// How long a series of ranges is that shows a wall.
struct WallFinderConfig {
  double window_m = 0.6;  ///< least length along the wall
  double most_m = 1.6;    ///< largest length
  double most_s = 12;     ///< an older range is no longer of the series
  WallFitConfig fit;

  void Describe(Archive& a);
};

/// Finds straight smooth walls from what single sensors hear while the base drives along them.
class WallFinder {
 public:
  WallFinder(const WallFinderConfig& config, const Footprint& footprint);

  /// Adds a cycle of the ring. `odom_from_base`: pose at its end. Returns the walls whose series it
  /// completed, in the frame of that pose; a series is used once.
  std::vector<WallSeen> Add(const SonarCycle& cycle, const Pose2& odom_from_base);

 private:
  struct Sample {
    Time time{};
    Pose2 odom_from_sonar;
    double range_m = 0;
  };
  using Series = std::deque<Sample>;
  static double LengthOf(const Series& series);

  WallFinderConfig config_;
  std::array<Pose2, kSonars> base_from_sonar_;
  std::array<Series, kSonars> series_;
};

}  // namespace priamos::robot
