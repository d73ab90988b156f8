#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/geometry.hpp"
#include "common/time.hpp"

namespace priamos::bench {

/// One echo, frame of the odometry.
struct PlacedEcho {
  Pose2 odom_from_sonar;
  double range_m = 0;
};

/// A map of things that is made of echoes.
class SonarGrid {
 public:
  virtual ~SonarGrid() = default;
  virtual void Add(const PlacedEcho& echo, Time now) = 0;
  /// Centres of the cells of 5 cm that are taken for things within `reach_m` of the base, base frame.
  virtual std::vector<Eigen::Vector2d> Things(const Pose2& odom_from_base, double reach_m,
                                              Time now) const = 0;
};

/// A grid by its name in the table.
struct GridKind {
  std::string name;
  std::function<std::unique_ptr<SonarGrid>()> make;
};

/// The robot's evidence grid first, then MRPT's occupancy grid, with several bounds between free and closed.
std::vector<GridKind> AllGrids();

#ifdef PRIAMOS_HAS_MRPT_NAV
/// mrpt::maps::COccupancyGridMap2D with ranges of a cone of `aperture_deg`; a cell is a thing from the
/// probability `thing` on. `certainty`: what one echo says at most.
std::unique_ptr<SonarGrid> MrptGrid(double aperture_deg, double certainty, double thing);
#endif

}  // namespace priamos::bench
