#pragma once

#include <Eigen/Core>
#include <vector>

#include "test/robot/support/simulated_sonars.hpp"

namespace priamos::robot {

/// Two legs of somebody who walks along y, with the middle between them at `at` [m]. Round, as far as sonars
/// are concerned: whatever the side, a face looks at them.
std::vector<Surface> RoundLegs(const Eigen::Vector2d& at);

}  // namespace priamos::robot
