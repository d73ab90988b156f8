#pragma once

#include <memory>
#include <vector>

#include "robot/core/base/odometry.hpp"
#include "test/bench/rivals/case.hpp"
#include "test/bench/rivals/sonar_grids.hpp"
#include "world/core/sonar/acoustic_scene.hpp"

namespace priamos::bench {

/// What a grid knows of the surroundings, summed over many moments.
struct GridFigures {
  double outline = 0, known = 0;      ///< places of outlines in sight, and those with a thing within 10 cm
  double free_m2 = 0, closed_m2 = 0;  ///< floor in reach, and what of it is taken for a thing 10 cm off any
  double echoes = 0, adding_s = 0;    ///< put in, and CPU time of that
};

/// Watches a drive: puts all echoes of the ring into grids side by side, by the odometry of the wheels, and
/// compares them with what truly stands within 1.5 m, twice a second.
class GridWatch {
 public:
  /// Adds to `figures`, one per kind, which outlive it.
  GridWatch(const Case& task, const std::vector<GridKind>& kinds, std::vector<GridFigures>& figures);

  void See(const Heard& heard, const Pose2& map_from_base);

 private:
  void Add(const world::SonarSample& sample);
  void Judge(const Pose2& map_from_base);
  void JudgeOutlines(const Pose2& map_from_base, const std::vector<std::vector<Eigen::Vector2d>>& things);
  double FreeAround(const Eigen::Vector2d& map) const;

  std::vector<Rectangle> outlines_;
  std::vector<Eigen::Vector2d> places_;  ///< on outlines, map frame
  world::AcousticScene scene_;
  robot::Odometry odometry_;
  std::vector<std::unique_ptr<SonarGrid>> grids_;
  std::vector<GridFigures>& figures_;
  Time now_{};
  int steps_ = 0;
};

/// One line per grid.
void PrintGrids(const std::vector<GridKind>& kinds, const std::vector<GridFigures>& figures);

}  // namespace priamos::bench
