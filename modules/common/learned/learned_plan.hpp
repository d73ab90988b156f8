#pragma once

#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"

namespace priamos {

/// A ground plan of what was learned: a wall behind each face that was heard, as thick as there is another
/// face behind it, else 10 cm. Gaps through which a base of `fits_m` does not drive as it likes, but through
/// which it may be led, are doors without a leaf; wider ones are left open. Faces shorter than 1 cm or beyond
/// 99 m are left out; wall_sigma_m is the median of the faces' ends. Frame of the learned walls.
GroundPlan PlanOf(const LearnedWalls& told, double fits_m);

}  // namespace priamos
