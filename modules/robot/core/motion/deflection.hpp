#pragma once

#include <Eigen/Core>
#include <functional>

#include "common/geometry.hpp"

namespace priamos::robot {

/// The part of a motion that may be driven, 0 to 1, as the last filter before the wheels sees it.
using JudgeMotion = std::function<double(const Twist2&)>;

/// The part of an operator's wish that is free of obstacles: of all motions whose components lie
/// between 0 and those of `wish`, scaled as `judge` allows, the one that comes farthest along the wish. So
/// pushing into a wall at a slant slides along it, pushing straight into it stops, and nothing is turned
/// round or invented. Because the judge is the filter that comes afterwards, the motion that is found is one
/// that it lets pass: the base stands only where no part of the wish is free. `reach_m` is the lever that
/// turns a turn rate into a speed.
Twist2 Deflected(const Twist2& wish, double reach_m, const JudgeMotion& judge);

}  // namespace priamos::robot
