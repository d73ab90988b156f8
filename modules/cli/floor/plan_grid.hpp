#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "common/ground_plan.hpp"

namespace priamos::cli {

/// A plan as map_server of ROS has it: grey cells, the first row at the top (largest y).
struct PlanGrid {
  double resolution_m = 0.05;
  Eigen::Vector2d low{0, 0};  ///< map, corner of the cell at the lower left
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;  ///< 0: a wall, a cupboard or a no-go area; 254: free
};

/// Cells of `resolution_m` from half a metre around the plan. A cell is taken where any of it is; the rest
/// counts as free, also outside of the building. Throws ConfigError for a plan without a wall.
PlanGrid GridOf(const GroundPlan& plan, double resolution_m);

/// The two files: a portable grey map, and the YAML that names it as `image`.
std::string ToPgm(const PlanGrid& grid);
std::string ToYaml(const PlanGrid& grid, const std::string& image);

}  // namespace priamos::cli
