#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "cli/scenario/true_world.hpp"
#include "common/ground_plan.hpp"
#include "common/rectangle.hpp"

namespace priamos::cli {

/// A solid of the simulated world from above.
struct TrueThing {
  std::string name;
  std::vector<Eigen::Vector2d> outline;  ///< map [m]
};

/// The walls of a plan and the frame of a door as rectangles.
std::vector<Rectangle> WallShapes(const GroundPlan& plan);
std::vector<Rectangle> FrameShapes(const DoorPlan& door);

/// The solids at the robot's height that are not where the plan has a wall or a frame: truth. Left out is
/// what is no thicker than 2 cm (skirting boards, posters), which belongs to its wall.
std::vector<TrueThing> ThingsBeyond(const GroundPlan& plan, const TrueWorld& world);

}  // namespace priamos::cli
