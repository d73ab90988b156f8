#include "planner/core/locate/place_plan.hpp"

#include <algorithm>
#include <cmath>

#include "common/cross.hpp"
#include "common/robot/body_size.hpp"

namespace priamos::planner {
namespace {

constexpr double kCell_m = 0.1;
/// A wall may stand so far beside its place on the plan: three sigmas of a survey with errors up to 10 cm.
constexpr double kAstray_m = 0.17;

/// Whether the lines between two pairs of places cross, ends included.
bool DoCross(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
             const Eigen::Vector2d& d) {
  const double c_side = Cross(b - a, c - a), d_side = Cross(b - a, d - a);
  const double a_side = Cross(d - c, a - c), b_side = Cross(d - c, b - c);
  return c_side * d_side <= 0 && a_side * b_side <= 0;
}

/// Front and sides of a cupboard; it stands with its back to something.
void AddCupboard(const CupboardPlan& cupboard, std::vector<WallFace>& faces) {
  const Pose2 at = cupboard.map_from_cupboard();
  const auto place = [&](double x, double y) { return at * Eigen::Vector2d(x, y); };
  const double half = cupboard.width_m / 2, depth = cupboard.depth_m;
  // Whoever sees them has them to the right of their direction.
  faces.push_back({place(0, -half), place(0, half)});
  faces.push_back({place(0, half), place(depth, half)});
  faces.push_back({place(depth, -half), place(0, -half)});
}

}  // namespace

PlacePlan::PlacePlan(const GroundPlan& plan) : sigma_m_(plan.wall_sigma_m) {
  std::vector<WallFace> faces = FacesOf(plan);
  for (const CupboardPlan& cupboard : plan.cupboards) AddCupboard(cupboard, faces);
  for (const WallFace& face : faces)
    faces_.push_back(
        {face.from, face.along(), face.length_m(), std::atan2(face.along().y(), face.along().x())});
  for (const WallPlan& wall : plan.walls) {
    walls_.push_back(wall.Shape());
    for (const Eigen::Vector2d& corner : walls_.back().Corners()) bounds_.extend(corner);
  }
  if (walls_.empty()) return;
  columns_ = 1 + static_cast<int>(bounds_.sizes().x() / kCell_m);
  rows_ = 1 + static_cast<int>(bounds_.sizes().y() / kCell_m);
  in_wall_.assign(std::size_t(columns_) * std::size_t(rows_), 0);
  const double near_m = kDrawnBody.width_m / 2 - kAstray_m;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector2d place = bounds_.min() + kCell_m * Eigen::Vector2d(column + 0.5, row + 0.5);
      in_wall_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)] =
          std::any_of(walls_.begin(), walls_.end(),
                      [&](const Rectangle& wall) { return Distance(wall, place) < near_m; });
    }
}

bool PlacePlan::IsInWall(const Eigen::Vector2d& middle) const {
  const Eigen::Vector2d at = (middle - bounds_.min()) / kCell_m;
  if (!(at.x() >= 0) || !(at.y() >= 0)) return false;
  const int column = static_cast<int>(at.x()), row = static_cast<int>(at.y());
  if (column >= columns_ || row >= rows_) return false;
  return in_wall_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
}

double PlacePlan::Free_m(const Eigen::Vector2d& from, const Eigen::Vector2d& ray, double most_m) const {
  for (double at_m = 0; at_m < most_m; at_m += kCell_m)
    if (IsInWall(from + at_m * ray)) return at_m;
  return most_m;
}

bool PlacePlan::Hides(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  return std::any_of(walls_.begin(), walls_.end(), [&](const Rectangle& wall) {
    const Eigen::Vector2d along(wall.half_m.x(), 0);
    return DoCross(from, to, wall.map_from_centre * Eigen::Vector2d(-along), wall.map_from_centre * along);
  });
}

}  // namespace priamos::planner
