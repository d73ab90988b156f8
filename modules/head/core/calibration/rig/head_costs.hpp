#pragma once

#include <ceres/cost_function.h>

#include "head/core/calibration/rig/head_residuals.hpp"

namespace priamos::head {

// The residuals with their derivatives, which take seconds to compile. The problem that a cost is added to
// owns it.

/// Cost of an observed disc; its blocks are head, mount, lens and jitter.
ceres::CostFunction* NewCost(const HeadReprojection& residual);
/// Cost of a block of N = kHead, kMount, kLens or kJitter numbers that is off its expected value.
template <int N>
ceres::CostFunction* NewCost(const Near<N>& residual);
/// Cost of a bend in the lenses of three nodes in a row, which are its blocks.
ceres::CostFunction* NewCost(const Smooth& residual);

}  // namespace priamos::head
