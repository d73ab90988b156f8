#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/ground_plan.hpp"
#include "robot/core/motion/path_shape.hpp"
#include "world/core/simulation.hpp"

namespace priamos::bench {

/// What the devices of the base said since the last step.
struct Heard {
  std::optional<world::WheelSample> wheels;
  std::optional<world::TouchSample> touch;
  std::optional<world::SonarSample> sonars;
};

/// Who drives a base along a path through things that are not on the plan: hears wheels and sonars, commands
/// wheels, 50 times a second. It knows where it starts, and nothing of the world.
class Driver {
 public:
  virtual ~Driver() = default;
  /// Speeds of the wheels from now on; nothing before the first command.
  virtual std::optional<world::PerWheel> Step(const Heard& heard, Time now) = 0;
};

/// What a driver is ordered: the pose at the start, and the path, both in the map frame; and the plan by
/// which the planner found it.
struct Order {
  Pose2 start;
  robot::Path path;
  GroundPlan plan{};
};

/// A driver by its name in the table.
struct DriverKind {
  std::string name;
  std::function<std::unique_ptr<Driver>(const Order&)> make;
};

}  // namespace priamos::bench
