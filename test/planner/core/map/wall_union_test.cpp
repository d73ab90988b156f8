#include "planner/core/map/wall_union.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>

#include "test/planner/core/learned.hpp"

namespace priamos::planner {
namespace {

TEST(OffsetOf, ComparesWhereBothAre) {
  const WallOffset dut = OffsetOf(WallAt(0, 0, 0, 4), WallAt(3, 0.1, 2, 4));
  EXPECT_NEAR(dut.gap_m, -1, 1e-9) << "beside each other from 1 to 2 m";
  EXPECT_NEAR(dut.across_m, 0.1 - 1.5 * std::tan(Radians(2)), 1e-3);
  EXPECT_NEAR(dut.yaw_rad, Radians(2), 1e-9);
  EXPECT_NEAR(OffsetOf(WallAt(0, 0, 0, 2), WallAt(4, 0, 0, 2)).gap_m, 2, 1e-9);
}

TEST(UnionOf, IsAsLongAsBothAndLiesBetween) {
  const LearnedWall dut = UnionOf(WallAt(0, 0, 0, 4), WallAt(3, 0.02, 0, 4));
  EXPECT_NEAR(dut.length_m, 7, 1e-9);
  EXPECT_NEAR(dut.x_m, 1.5, 0.01);
  EXPECT_GE(dut.y_m, -0.001);
  EXPECT_LE(dut.y_m, 0.021);
}

TEST(UnionOf, TheSurerOneCounts) {
  LearnedWall rough = WallAt(0, 0.1, 0, 4);
  rough.sigma_across_m = 0.3;
  rough.sigma_yaw_deg = 5;
  const LearnedWall dut = UnionOf(rough, WallAt(0, 0, 0, 4));
  EXPECT_NEAR(dut.y_m, 0, 0.005);
  EXPECT_NEAR(dut.sigma_across_m, 0.02, 0.003);
}

/// Consistent whatever the correlation: never surer than the surer of both by more than the least sigmas.
RC_GTEST_PROP(UnionOf, IsNeverSurerThanCovarianceIntersectionMayBe, ()) {
  const auto number = [](double scale) { return *rc::gen::inRange(-100, 101) / 100.0 * scale; };
  LearnedWall a = WallAt(number(5), number(0.1), number(3), 3),
              b = WallAt(number(5), number(0.1), number(3), 3);
  a.rho = number(0.9);
  b.sigma_across_m = 0.02 + std::abs(number(0.2));
  const LearnedWall dut = UnionOf(a, b);
  const Eigen::Matrix2d covariance = dut.covariance();
  RC_ASSERT(covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() >= 0);
  RC_ASSERT(covariance.determinant() >=
            0.2 * std::min(a.covariance().determinant(), b.covariance().determinant()));
  RC_ASSERT(dut.length_m >= 3 - 1e-6);
}

}  // namespace
}  // namespace priamos::planner
