#pragma once

#include <limits>
#include <string>
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
    std::string name;  ///< name of the obstacle, for messages; empty if there is none
  };

  explicit ObstacleMap(const GroundPlan& plan);

  Nearest NearestTo(const Rectangle& footprint) const;

 private:
  struct Obstacle {
    std::string name;
    Rectangle shape;
  };
  void AddFrame(const DoorPlan& door);

  std::vector<Obstacle> obstacles_;
};

}  // namespace priamos::planner
