#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/input/section_place.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// `[grid]` of a world file: a map of ROS' map_server stands in for walls.
struct GridPlan {
  std::string yaml;     ///< the map's YAML file; empty: there is none
  double reach_m = 15;  ///< cells farther from the nominal start are left out
  std::string material = "plaster";
  SectionPlace place;  ///< where it was read, for errors

  void Describe(Archive& a);
};

/// What the YAML file of a map says.
struct GridHeader {
  std::string image;
  double resolution_m = 0;
  Pose2 map_from_grid;  ///< the lower left corner of the lower left cell
  bool negate = false;
  double occupied_thresh = 0.65;
};

/// Reads the YAML of a map; `file` stands for it in messages. Throws ConfigError, `file:line:key: ...`.
GridHeader ParseGridHeader(const std::string& file, std::string_view text);

/// Cells of a map, row by row from the lower left one.
struct OccupancyGrid {
  GridHeader header;
  int width = 0, height = 0;
  std::vector<bool> occupied;

  bool At(int x, int y) const { return occupied[static_cast<std::size_t>(y) * width + x]; }
};

/// Reads a grey PGM (P5 or P2, up to 255 grey levels, up to 8192 pixels a side). Throws ConfigError.
OccupancyGrid ParseGrid(const GridHeader& header, const std::string& file, std::string_view pgm);

/// Solids from the floor to `height_m` that cover the occupied cells whose middle is within `plan.reach_m` of
/// `around`: rectangles as large as they go, one after the other, so that a straight wall is one solid.
std::vector<Solid> GridSolids(const OccupancyGrid& grid, const GridPlan& plan, const Eigen::Vector2d& around,
                              double height_m);

}  // namespace priamos::world
