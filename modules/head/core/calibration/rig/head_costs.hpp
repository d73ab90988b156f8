#pragma once

#include <ceres/cost_function.h>

#include "head/core/calibration/rig/head_residuals.hpp"

namespace priamos::head {

// The residuals with their derivatives, which take seconds to compile. The problem that a cost is added to
// owns it.

/// Of the blocks head, mount, lens and jitter.
ceres::CostFunction* NewCost(const HeadReprojection& residual);
/// For N = kHead, kMount, kLens and kJitter.
template <int N>
ceres::CostFunction* NewCost(const Near<N>& residual);
/// Of the lenses of three nodes in a row.
ceres::CostFunction* NewCost(const Smooth& residual);

}  // namespace priamos::head
