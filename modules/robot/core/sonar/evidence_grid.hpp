#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// How echoes become evidence for and against things, and for how long.
struct EvidenceGridConfig {
  double reach_m = 2.0;  ///< echoes from farther away say nothing about a place: their arcs are too wide
  double half_beam_deg = 7.5;  ///< an echo lies anywhere on this arc
  double through_deg = 5;      ///< a beam shows that there is nothing only so near to its axis
  double hit = 0.7;            ///< log odds for a cell by an echo whose arc is no wider than sure_arc_m
  double miss = 0.5;           ///< log odds against a cell that a beam goes through
  double sure_arc_m = 0.15;    ///< a wider arc says less of each of its cells
  double thing = 1.2;          ///< log odds from which on a cell is taken for a thing
  double keep_s = 30;          ///< evidence that nothing renews is forgotten after this

  void Describe(Archive& a);
};

/// Evidence of the sonars for things around the base: log odds in cells of 5 cm, frame of the odometry
/// (Moravec and Elfes, "High resolution maps from wide angle sonar", ICRA 1985). An echo speaks for all cells
/// of its arc, a little for each where the arc is wide, and against those before it. So a thing gets its
/// place when it is heard from several places, and is gone when a beam sees what is behind it. For planning;
/// what keeps the base off things does not wait for evidence.
class EvidenceGrid {
 public:
  explicit EvidenceGrid(const EvidenceGridConfig& config);

  /// Weighs a believed echo at `range_m` of a sensor at `odom_from_sonar`.
  void Add(const Pose2& odom_from_sonar, double range_m, Time now);
  /// Centres of the cells that are taken for things within reach of `odom_from_base`, in that base frame [m].
  std::vector<Eigen::Vector2d> Things(const Pose2& odom_from_base, Time now) const;

 private:
  /// A cell of the plane; of the cells that share its place in memory, the one that was touched last.
  struct Cell {
    int x = 0, y = 0;
    double log_odds = 0;
    Time renewed{};
  };
  /// An echo, and the slopes of the edges of what it speaks for and of what it clears.
  struct Echo {
    Eigen::Isometry2d sonar_from_odom;
    double range_m = 0, beam = 0, through = 0;
  };
  Cell& At(int x, int y);
  void Weigh(int x, int y, const Echo& echo, Time now);

  EvidenceGridConfig config_;
  std::vector<Cell> cells_;
};

}  // namespace priamos::robot
