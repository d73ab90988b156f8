#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/rectangle.hpp"
#include "planner/core/map/wall_faces.hpp"

namespace priamos::planner {

/// A face of the plan; whoever sees it has it to the right of its direction.
struct PlaceFace {
  Eigen::Vector2d from{0, 0}, along{1, 0};
  double length_m = 0, yaw_rad = 0;

  Eigen::Vector2d left() const { return {-along.y(), along.x()}; }
};

/// A plan as far as finding a place on it needs it: the faces that sonars hear, where no base can be, and
/// what no sound goes through. Doorways are bridged: a leaf may close them, and then they are heard as wall.
class PlacePlan {
 public:
  explicit PlacePlan(const GroundPlan& plan);

  const std::vector<PlaceFace>& faces() const { return faces_; }
  /// Standard deviation of a face's place, across it [m].
  double sigma_m() const { return sigma_m_; }
  /// Around all walls.
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }
  /// Whether the middle of a base is there where the plan has a wall, or so near to it that the base would
  /// have to stand in it, whatever the plan's errors.
  bool IsInWall(const Eigen::Vector2d& middle) const;
  /// How far the middle of a base gets from a place in a direction of length 1 before it is in a wall,
  /// `most_m` at most.
  double Free_m(const Eigen::Vector2d& from, const Eigen::Vector2d& ray, double most_m) const;
  /// Whether a wall of the plan stands between two places.
  bool Hides(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

 private:
  std::vector<PlaceFace> faces_;
  std::vector<Rectangle> walls_;
  double sigma_m_;
  Eigen::AlignedBox2d bounds_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> in_wall_;  ///< row by row
};

}  // namespace priamos::planner
