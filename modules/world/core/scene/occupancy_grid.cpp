#include "world/core/scene/occupancy_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "world/core/scene/scene.hpp"

namespace priamos::world {
namespace {

/// A rectangle of cells.
struct Block {
  int x, y, width, height;
  int area() const { return width * height; }
};

/// Takes rectangles of cells out of a grid until none is left.
class Blocks {
 public:
  Blocks(int width, int height) : width_(width), height_(height), left_(std::size_t(width) * height) {}

  void Set(int x, int y) { left_[Index(x, y)] = true; }

  std::vector<Block> TakeAll() {
    std::vector<Block> blocks;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (left_[Index(x, y)]) blocks.push_back(Take(x, y));
    return blocks;
  }

 private:
  std::size_t Index(int x, int y) const { return std::size_t(y) * width_ + x; }
  bool Full(int x0, int x1, int y0, int y1) const {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        if (x >= width_ || y >= height_ || !left_[Index(x, y)]) return false;
    return true;
  }
  /// Grown along x first, or along y first.
  Block Grow(int x, int y, bool along_x) const {
    Block b{x, y, 1, 1};
    const auto widen = [&] {
      while (Full(x + b.width, x + b.width + 1, y, y + b.height)) ++b.width;
    };
    const auto heighten = [&] {
      while (Full(x, x + b.width, y + b.height, y + b.height + 1)) ++b.height;
    };
    if (along_x) widen();
    heighten();
    widen();
    return b;
  }
  Block Take(int x, int y) {
    const Block wide = Grow(x, y, true), high = Grow(x, y, false);
    const Block b = wide.area() >= high.area() ? wide : high;
    for (int j = y; j < y + b.height; ++j)
      for (int i = x; i < x + b.width; ++i) left_[Index(i, j)] = false;
    return b;
  }

  int width_, height_;
  std::vector<bool> left_;
};

}  // namespace

void GridPlan::Describe(Archive& a) {
  NotePlace(a, place);
  a.Text("yaml", yaml,
         "YAML file of a map of ROS' map_server, relative to the deployment's folder; empty: none");
  a.Number("reach_m", reach_m, {"m", 1, 100, "cells farther from the nominal start are left out"});
  a.Choice("material", material, MaterialNames(), "how its walls look and echo");
}

std::vector<Solid> GridSolids(const OccupancyGrid& grid, const GridPlan& plan, const Eigen::Vector2d& around,
                              double height_m) {
  const double cell_m = grid.header.resolution_m;
  const auto in_map = [&](double x, double y) {
    return grid.header.map_from_grid * Eigen::Vector2d(x * cell_m, y * cell_m);
  };
  Blocks blocks(grid.width, grid.height);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      if (grid.At(x, y) && (in_map(x + 0.5, y + 0.5) - around).norm() <= plan.reach_m) blocks.Set(x, y);
  std::vector<Solid> solids;
  for (const Block& b : blocks.TakeAll()) {
    const Eigen::Vector2d middle = in_map(b.x + b.width / 2.0, b.y + b.height / 2.0);
    solids.push_back({fmt::format("grid {}", solids.size() + 1),
                      {middle.x(), middle.y(), grid.header.map_from_grid.yaw},
                      {b.width * cell_m, b.height * cell_m},
                      0,
                      height_m,
                      plan.material});
  }
  return solids;
}

}  // namespace priamos::world
