#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "robot/core/base/footprint.hpp"
#include "robot/core/motion/detour_line.hpp"
#include "robot/core/motion/path_shape.hpp"

namespace priamos::robot {

/// The best way along `path` from `here`, around `things` (map frame [m]), within the leeway of each line: a
/// search over distances along the path and beside it, the base with the heading that the path has there. Of
/// two ways, the shorter one that keeps more off things and nearer to the path and to `last`. nullopt: there
/// is none.
std::optional<Detour> FindDetour(const DetourConfig& config, const Footprint& footprint,
                                 const PathShape& path, const PathPlace& here,
                                 std::span<const Eigen::Vector2d> things, const Detour& last,
                                 Things taken = Things::kAsHeard);

}  // namespace priamos::robot
