#include "head/core/calibration/rig/head_costs.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace priamos::head {
namespace {

TEST(HeadCostsTest, NearCountsInSigmas) {
  const Near<kJitter> near{{1, 2, 3, 4}, {1, 2, 4, 8}};
  const std::unique_ptr<ceres::CostFunction> dut(NewCost(near));
  const double block[] = {2, 4, 7, 12};
  const double* const blocks[] = {block};
  double residuals[kJitter], derivative[kJitter * kJitter];
  double* derivatives[] = {derivative};
  ASSERT_TRUE(dut->Evaluate(blocks, residuals, derivatives));
  for (const double residual : residuals) EXPECT_EQ(residual, 1);
  for (int i = 0; i < kJitter; ++i)
    for (int k = 0; k < kJitter; ++k) EXPECT_EQ(derivative[i * kJitter + k], i == k ? 1 / near.sigma[i] : 0);
}

TEST(HeadCostsTest, HaveTheBlocksThatTheirResidualsTake) {
  const std::unique_ptr<ceres::CostFunction> reprojection(NewCost(HeadReprojection{})),
      smooth(NewCost(Smooth{}));
  EXPECT_EQ(reprojection->parameter_block_sizes(), (std::vector<int>{kHead, kMount, kLens, kJitter}));
  EXPECT_EQ(reprojection->num_residuals(), 2);
  EXPECT_EQ(smooth->parameter_block_sizes(), (std::vector<int>{kLens, kLens, kLens}));
  EXPECT_EQ(smooth->num_residuals(), kLens - 1);
}

}  // namespace
}  // namespace priamos::head
