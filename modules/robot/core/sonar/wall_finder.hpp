#pragma once

#include <array>
#include <bitset>
#include <deque>
#include <optional>
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
  double window_m = 0.8;  ///< least length along the wall
  double most_m = 1.0;    ///< largest length
  double most_s = 12;     ///< an older range is no longer of the series
  WallFitConfig fit;

  void Describe(Archive& a);
};

/// What the newest cycle of the ring tells of walls.
struct WallsHeard {
  std::vector<WallSeen> walls;   ///< frame of the base at the end of the cycle
  std::bitset<kSonars> sensors;  ///< those whose newest ranges, this one included, are a wall's
};

/// Finds straight smooth walls from what single sensors hear while the base drives along them.
class WallFinder {
 public:
  WallFinder(const WallFinderConfig& config, const Footprint& footprint);

  /// Adds a cycle of the ring. `odom_from_base`: pose at its end.
  WallsHeard Add(const SonarCycle& cycle, const Pose2& odom_from_base);

 private:
  struct Sample {
    Time time{};
    Pose2 odom_from_sonar;
    double range_m = 0;
  };
  using Series = std::deque<Sample>;
  std::optional<WallSeen> WallOf(const Series& series, const Pose2& odom_from_base) const;
  static double LengthOf(const Series& series);

  WallFinderConfig config_;
  std::array<Pose2, kSonars> base_from_sonar_;
  std::array<Series, kSonars> series_;
};

}  // namespace priamos::robot
