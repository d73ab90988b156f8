#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/floor/true_floor.hpp"
#include "planner/core/explore/exploration.hpp"
#include "test/bench/floors/heard_walls.hpp"

namespace priamos::bench {

/// What was driven for one choice of the exploration.
struct Leg {
  double from_m = 0, to_m = 0;        ///< driven before and after
  double seen_from = 0, seen_to = 0;  ///< share of the reachable floor
  Eigen::Vector2d target{0, 0};
  double length_m = 0;  ///< of its border
  bool again = false;   ///< in a round over what was given up
};

/// An exploration alone on a true floor: no robot, no radio, no drift. The base drives the shortest true way
/// to each goal; where that is much longer than the exploration thinks, it is stopped instead.
class FloorDrive {
 public:
  FloorDrive(const cli::TrueWorld& world, const Eigen::Vector2d& start, std::uint64_t seed,
             const planner::ExplorationConfig& config);

  /// Until nothing is left, with so many rounds over what was given up that see nothing more.
  void Run(int rounds);

  const cli::TrueFloor& floor() const { return floor_; }
  const std::vector<Leg>& legs() const { return legs_; }
  double driven_m() const { return driven_m_; }
  double choosing_s() const { return choosing_s_; }
  /// Driven until so much was seen; all of it when it never was.
  double DrivenUntil(double seen) const;
  planner::Exploration& exploration() { return exploration_; }

 private:
  void DriveTo(const planner::FrontierGoal& goal);
  void StopBefore(const planner::FrontierGoal& goal);
  bool Follow(const std::vector<Eigen::Vector2d>& way, const planner::FrontierGoal& goal);
  void Step(const Eigen::Vector2d& to);
  std::vector<Eigen::Vector2d> WayTo(const Eigen::Vector2d& to) const;

  cli::TrueFloor floor_;
  HeardWalls heard_;
  planner::Exploration exploration_;
  Pose2 base_;
  double driven_m_ = 0, choosing_s_ = 0;
  int missed_ = 0;
  bool again_ = false;
  Eigen::Vector2d last_target_{1e9, 0};
  std::vector<Leg> legs_;
  std::vector<std::pair<double, double>> seen_;  ///< driven, share
};

}  // namespace priamos::bench
