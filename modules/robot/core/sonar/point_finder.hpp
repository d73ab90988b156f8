#pragma once

#include <bitset>
#include <deque>
#include <span>
#include <vector>

#include "common/time.hpp"
#include "robot/core/sonar/arc_votes.hpp"
#include "robot/core/sonar/point_fit.hpp"
#include "robot/core/sonar/waiting_echoes.hpp"

namespace priamos::robot {

/// Which echoes count, and for how long.
struct PointFinderConfig {
  double window_m = 3;     ///< an echo is forgotten after the base has driven so far ...
  double window_s = 30;    ///< ... or after this time
  int votes = 14;          ///< echoes through one place that are looked at closely
  double gate_m = 0.03;    ///< an echo so far off is one of a place that is known
  double keep_m = 3;       ///< a place takes no more after the base has driven so far without hearing it
  double through_m = 1.5;  ///< from so near a place is heard by a beam ...
  double through_deg = 5;  ///< ... that points so near to it
  int through = 12;        ///< directions, 2 degrees apart, from which beams saw through it: it has gone
  PointFitConfig fit;

  void Describe(Archive& a);
};

/// A place that echoes to all sides, and when it was heard last.
struct FoundPoint {
  int number = 0;  ///< from 1; stays when it is known better
  Time heard{};
  PointFit fit;
  double facing_rad = 0;  ///< direction from the base to it when it was found, frame of the odometry
  double travel_m = 0;    ///< how far the base had driven when it was heard last
};

/// Finds inner corners and edges from the echoes of the moving ring that no wall explains: where the arcs of
/// enough of them cross a place is fitted, and what is surely one (FitPoint) is told. From then on it gets
/// better by every echo.
class PointFinder {
 public:
  PointFinder(const PointFinderConfig& config, const OdometryNoise& odometry);

  /// Takes the echoes of a cycle that no wall explains. Returns the places that began or changed.
  std::vector<const FoundPoint*> Add(std::span<const PlacedEcho> unexplained, Time now);
  /// Whether an echo can be one of a place that is known.
  bool Explains(const PlacedEcho& echo) const;
  /// Takes all echoes of a cycle. Returns the numbers of places that are none any more: from many directions
  /// in a row beams that point there heard what is behind. Silence tells nothing, a sensor may be deaf.
  std::vector<int> SeeThrough(std::span<const PlacedEcho> heard);

 private:
  struct Point {
    FoundPoint found;
    std::vector<PlacedEcho> echoes;
    std::bitset<180> seen_through_from{};  ///< directions from it, since it was heard last
  };
  void Forget(Time now, double travel_m);
  void NoteSight(const PlacedEcho& echo, Point& point) const;
  bool Grow(const PlacedEcho& echo, Time now, std::vector<const FoundPoint*>& changed);
  const FoundPoint* Begin(std::span<const PlacedEcho> newest, Time now);
  Eigen::Vector2d Refined(Eigen::Vector2d place) const;
  std::vector<PlacedEcho> Supporters(const Eigen::Vector2d& place, double gate_m) const;

  PointFinderConfig config_;
  OdometryNoise odometry_;
  WaitingEchoes<ArcVotes> waiting_;  ///< for a place that explains them
  std::deque<Point> points_;
  int last_number_ = 0;
};

}  // namespace priamos::robot
