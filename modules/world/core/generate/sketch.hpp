#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/random.hpp"

namespace priamos::world {

inline constexpr double kHalfWall_m = 0.07;  ///< half the thickness of a made-up wall

/// A door in a wall of a sketch.
struct SketchDoor {
  double along_m = 0;   ///< middle of the opening, from the wall's beginning
  bool to_left = true;  ///< it leads to the left of the wall's direction
  DoorPlan door;        ///< its dimensions and number; the place follows from the wall
};

/// A straight wall with its doors.
struct SketchWall {
  std::string name;
  Eigen::Vector2d from, to;
  std::vector<SketchDoor> doors;
};

/// A building as walls with doors in them.
struct Sketch {
  std::vector<SketchWall> walls;
};

/// The ground plan of the sketch: walls end at the openings of their doors.
GroundPlan PlanOf(const Sketch& sketch);

/// Standard deviation of a wall's end in a survey, across it: what is uniform over 6 cm.
inline constexpr double kSurveyedWall_m = 0.0173;

/// The sketch as a person with a tape gets it in an afternoon: either end of a wall up to 3 cm beside its
/// place, a door up to 10 cm along its wall, every dimension of a door with 5 mm of error (one sigma), and an
/// opening that may in truth be up to 2 cm narrower.
Sketch Surveyed(Sketch sketch, Rng& rng);

}  // namespace priamos::world
