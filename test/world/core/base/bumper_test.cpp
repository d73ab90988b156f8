#include "world/core/base/bumper.hpp"

#include <gtest/gtest.h>

namespace priamos::world {
namespace {

const Eigen::Vector2d kFootprint(0.95, 0.78);

Solid Post(double x, double y, double low = 0, double high = 1) {
  return {"post", {x, y, 0}, {0.05, 0.05}, low, high, "metal"};
}

std::uint8_t PressedBy(const Solid& solid, const Pose2& base = {}) {
  return Bumper({}, kFootprint, {solid}).Pressed(base);
}

TEST(Bumper, ASwitchPerHalfOfEachSideCounterClockwiseFromTheFrontsLeft) {
  const double x = 0.475 + 0.0255, y = 0.39 + 0.0255;
  EXPECT_EQ(PressedBy(Post(x, 0.2)), 1);
  EXPECT_EQ(PressedBy(Post(0.2, y)), 2);
  EXPECT_EQ(PressedBy(Post(-0.2, y)), 4);
  EXPECT_EQ(PressedBy(Post(-x, 0.2)), 8);
  EXPECT_EQ(PressedBy(Post(-x, -0.2)), 16);
  EXPECT_EQ(PressedBy(Post(-0.2, -y)), 32);
  EXPECT_EQ(PressedBy(Post(0.2, -y)), 64);
  EXPECT_EQ(PressedBy(Post(x, -0.2)), 128);
  EXPECT_EQ(PressedBy(Post(x, 0)), 1 + 128) << "in the middle of a side";
}

TEST(Bumper, IsPressedFromAMillimetreOn) {
  EXPECT_EQ(PressedBy(Post(0.475 + 0.025 + 0.0009, 0.2)), 1);
  EXPECT_EQ(PressedBy(Post(0.475 + 0.025 + 0.0011, 0.2)), 0);
}

TEST(Bumper, FeelsNothingAboveOrBelowItself) {
  EXPECT_EQ(PressedBy(Post(0.5, 0.2, 0.31, 0.75)), 0) << "a table top";
  EXPECT_EQ(PressedBy(Post(0.5, 0.2, 0, 0.02)), 0) << "a threshold";
  EXPECT_EQ(PressedBy(Post(0.5, 0.2, 0.29, 0.75)), 1);
}

TEST(Bumper, MovesWithTheBase) {
  EXPECT_EQ(PressedBy(Post(2.2, 3.5), {2, 3, kPi / 2}), 128) << "x of the base is y of the map";
}

}  // namespace
}  // namespace priamos::world
