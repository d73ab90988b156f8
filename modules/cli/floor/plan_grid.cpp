#include "cli/floor/plan_grid.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/config.hpp"
#include "common/rectangle.hpp"

namespace priamos::cli {
namespace {

constexpr double kAround_m = 0.5;
constexpr std::uint8_t kTaken = 0, kFree = 254;

std::vector<Rectangle> ShapesOf(const GroundPlan& plan) {
  std::vector<Rectangle> shapes;
  for (const WallPlan& wall : plan.walls) shapes.push_back(wall.Shape());
  for (const CupboardPlan& c : plan.cupboards)
    shapes.push_back({c.map_from_cupboard() * Pose2{c.depth_m / 2, 0, 0}, {c.depth_m / 2, c.width_m / 2}});
  for (const NoGoPlan& area : plan.no_go) shapes.push_back(area.Shape());
  return shapes;
}

Eigen::AlignedBox2d BoundsOf(const std::vector<Rectangle>& shapes) {
  Eigen::AlignedBox2d box;
  for (const Rectangle& shape : shapes)
    for (const Eigen::Vector2d& corner : shape.Corners()) box.extend(corner);
  return box;
}

/// Takes the cells of which any part is in the shape: half a cell around its middle, as a square.
void Fill(const Rectangle& shape, PlanGrid& grid) {
  const double half_m = grid.resolution_m / 2;
  const Eigen::AlignedBox2d box = BoundsOf({shape});
  const auto cell = [&](double at_m, double low_m, int most) {
    return std::clamp(static_cast<int>(std::floor((at_m - low_m) / grid.resolution_m)), 0, most - 1);
  };
  for (int row = cell(box.min().y(), grid.low.y(), grid.height);
       row <= cell(box.max().y(), grid.low.y(), grid.height); ++row)
    for (int column = cell(box.min().x(), grid.low.x(), grid.width);
         column <= cell(box.max().x(), grid.low.x(), grid.width); ++column) {
      const Eigen::Vector2d middle = grid.low + grid.resolution_m * Eigen::Vector2d(column + 0.5, row + 0.5);
      const Rectangle square{{middle.x(), middle.y(), 0}, {half_m, half_m}};
      if (Distance(square, shape) <= 0)
        grid.grey[std::size_t(grid.height - 1 - row) * std::size_t(grid.width) + std::size_t(column)] =
            kTaken;
    }
}

}  // namespace

PlanGrid GridOf(const GroundPlan& plan, double resolution_m) {
  const std::vector<Rectangle> shapes = ShapesOf(plan);
  if (shapes.empty()) throw ConfigError("expected a plan with walls, got none");
  const Eigen::AlignedBox2d box = BoundsOf(shapes);
  PlanGrid grid;
  grid.resolution_m = resolution_m;
  grid.low = box.min() - Eigen::Vector2d::Constant(kAround_m);
  const Eigen::Vector2d size_m = box.sizes() + Eigen::Vector2d::Constant(2 * kAround_m);
  grid.width = static_cast<int>(std::ceil(size_m.x() / resolution_m));
  grid.height = static_cast<int>(std::ceil(size_m.y() / resolution_m));
  grid.grey.assign(std::size_t(grid.width) * std::size_t(grid.height), kFree);
  for (const Rectangle& shape : shapes) Fill(shape, grid);
  return grid;
}

std::string ToPgm(const PlanGrid& grid) {
  std::string text = fmt::format("P5\n{} {}\n255\n", grid.width, grid.height);
  text.append(grid.grey.begin(), grid.grey.end());
  return text;
}

std::string ToYaml(const PlanGrid& grid, const std::string& image) {
  return fmt::format(
      "image: {}\nresolution: {:.3f}\norigin: [{:.4f}, {:.4f}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n",
      image, grid.resolution_m, grid.low.x(), grid.low.y());
}

}  // namespace priamos::cli
