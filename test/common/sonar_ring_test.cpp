#include "common/sonar_ring.hpp"

#include <gtest/gtest.h>

#include "common/rectangle.hpp"

namespace priamos {
namespace {

const Eigen::Vector2d kFootprint(0.95, 0.78);

TEST(BaseFromSonar, FirstLooksAheadThenCounterClockwise) {
  const Pose2 s1 = BaseFromSonar(0, kFootprint), s7 = BaseFromSonar(6, kFootprint),
              s13 = BaseFromSonar(12, kFootprint);
  EXPECT_NEAR(s1.x, 0.475, 1e-12);
  EXPECT_NEAR(s1.y, 0, 1e-12);
  EXPECT_NEAR(s1.yaw, 0, 1e-12);
  EXPECT_NEAR(s7.y, 0.39, 1e-12);
  EXPECT_NEAR(s7.yaw, kPi / 2, 1e-12);
  EXPECT_NEAR(s13.x, -0.475, 1e-12);
}

TEST(BaseFromSonar, EverySensorSitsOnTheOutline) {
  const Rectangle footprint{{0, 0, 0}, kFootprint / 2};
  for (int i = 0; i < kSonars; ++i) {
    const Eigen::Vector2d at = BaseFromSonar(i, kFootprint).translation();
    EXPECT_NEAR((footprint.ToLocal(at).cwiseAbs() - footprint.half_m).maxCoeff(), 0, 1e-12) << i;
  }
}

TEST(BaseFromSonar, FollowsTheFootprintItIsGiven) {
  EXPECT_NEAR(BaseFromSonar(0, {1.2, 0.78}).x, 0.6, 1e-12);
  EXPECT_NEAR(BaseFromSonar(6, {1.2, 0.5}).y, 0.25, 1e-12);
}

}  // namespace
}  // namespace priamos
