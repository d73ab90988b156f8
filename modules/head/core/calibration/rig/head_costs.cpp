#include "head/core/calibration/rig/head_costs.hpp"

#include <ceres/autodiff_cost_function.h>

namespace priamos::head {

ceres::CostFunction* NewCost(const HeadReprojection& residual) {
  return new ceres::AutoDiffCostFunction<HeadReprojection, 2, kHead, kMount, kLens, kJitter>(
      new HeadReprojection(residual));
}

template <int N>
ceres::CostFunction* NewCost(const Near<N>& residual) {
  return new ceres::AutoDiffCostFunction<Near<N>, N, N>(new Near<N>(residual));
}

template ceres::CostFunction* NewCost(const Near<kHead>&);
template ceres::CostFunction* NewCost(const Near<kMount>&);
template ceres::CostFunction* NewCost(const Near<kLens>&);
template ceres::CostFunction* NewCost(const Near<kJitter>&);

ceres::CostFunction* NewCost(const Smooth& residual) {
  return new ceres::AutoDiffCostFunction<Smooth, kLens - 1, kLens, kLens, kLens>(new Smooth(residual));
}

}  // namespace priamos::head
