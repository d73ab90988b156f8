#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/rectangle.hpp"

namespace priamos::planner {

/// Everything of the ground plan that a footprint must not touch: walls, and the door frames that stand
/// before them.
class ObstacleMap {
 public:
  /// The obstacle nearest to a footprint.
  struct Nearest {
    double distance_m = std::numeric_limits<double>::infinity();
    std::string_view name;  ///< name of the obstacle, for messages; empty if there is none. The map owns it
  };

  explicit ObstacleMap(const GroundPlan& plan);
  /// Adds what else must not be touched.
  void Add(std::string name, const Rectangle& shape);

  Nearest NearestTo(const Rectangle& footprint) const;
  /// The smallest box that holds all obstacles [m]; empty without any.
  Eigen::AlignedBox2d Bounds() const;

  /// One obstacle after the other, for who wants to know what is near to many places.
  std::size_t size() const { return obstacles_.size(); }
  Eigen::AlignedBox2d BoundsOf(std::size_t obstacle) const;
  const Rectangle& ShapeOf(std::size_t obstacle) const { return obstacles_[obstacle].shape; }
  double DistanceTo(std::size_t obstacle, const Eigen::Vector2d& in_map) const {
    return obstacles_[obstacle].DistanceTo(in_map);
  }

 private:
  struct Obstacle {
    std::string name;
    Rectangle shape;
    Eigen::Matrix2d own_from_map;  ///< rotation into its own axes
    double DistanceTo(const Eigen::Vector2d& in_map) const;
  };
  void AddFrame(const DoorPlan& door);

  std::vector<Obstacle> obstacles_;
};

}  // namespace priamos::planner
