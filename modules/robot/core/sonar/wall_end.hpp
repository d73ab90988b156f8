#pragma once

#include <span>

#include "robot/core/sonar/wall_fit.hpp"

namespace priamos::robot {

/// An echo of a wall: where along its line the sensor was, how far the line is from there, and what it heard.
struct EchoBeside {
  double along_m = 0, line_m = 0, range_m = 0;
};

/// Where a wall ends along its line.
struct WallEnd {
  double along_m = 0;
  double sigma_m = 0;
};

/// The end towards which `along_m` grows, of a wall that was heard at least once. A beam hears an edge also
/// from beyond it, where the edge is farther away than the line: by sqrt(line^2 + beyond^2). That bend in the
/// last ranges is where the wall ends; without one it ends where it was heard last, or half a beam before.
WallEnd FindWallEnd(std::span<const EchoBeside> echoes, const WallFitConfig& noise);

}  // namespace priamos::robot
