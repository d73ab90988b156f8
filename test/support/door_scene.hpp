#pragma once

#include <vector>

#include "world/core/scene/solid.hpp"

namespace priamos::test {

/// Where the door of DoorScene() stands: middle of its opening on the floor, x in driving direction.
inline constexpr Pose2 kMapFromDoor{6.0, 2.4, 0};
inline constexpr double kDoorWidth_m = 0.90, kDoorHeight_m = 2.00;

/// Two rooms with a door between them, the plan of config/sim/maps/door.toml, furnished: for tests of seeing
/// that should not depend on world files. The leaf is named "door leaf".
std::vector<world::Solid> DoorScene(double leaf_angle_rad = 1.75);
/// Pose of the open leaf.
Pose2 MapFromLeaf(double leaf_angle_rad);

}  // namespace priamos::test
