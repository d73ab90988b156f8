#include "robot/core/base/footprint.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace priamos::robot {
namespace {

const Footprint kDut{.length_m = 1.0, .width_m = 0.8};

TEST(Footprint, DistanceIsMeasuredToTheNearestSide) {
  EXPECT_NEAR(kDut.Distance({0.7, 0.1}), 0.2, 1e-12);
  EXPECT_NEAR(kDut.Distance({0.1, -0.5}), 0.1, 1e-12);
}

TEST(Footprint, DistanceIsMeasuredToTheCornerBesideBothSides) {
  EXPECT_NEAR(kDut.Distance({0.8, 0.8}), 0.5, 1e-12);
}

TEST(Footprint, DistanceIsNegativeInside) {
  EXPECT_NEAR(kDut.Distance({0, 0}), -0.4, 1e-12);
  EXPECT_NEAR(kDut.Distance({0.45, 0}), -0.05, 1e-12);
}

TEST(Footprint, NearestLiesOnTheSideOrCornerThatFacesThePoint) {
  EXPECT_EQ(kDut.Nearest({0.7, 0.1}), Eigen::Vector2d(0.5, 0.1));
  EXPECT_EQ(kDut.Nearest({-0.8, 0.8}), Eigen::Vector2d(-0.5, 0.4));
}

TEST(Footprint, ReachIsTheWayToACorner) {
  EXPECT_NEAR(kDut.Reach(), std::hypot(0.5, 0.4), 1e-12);
}

}  // namespace
}  // namespace priamos::robot
