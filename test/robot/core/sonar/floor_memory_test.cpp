#include "robot/core/sonar/floor_memory.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;

constexpr Time kStart = FromUtime(1'000'000'000);

FloorLine Line(Time exposure, double height_m, double x_m = 2.02) {
  return {exposure, {{{x_m, -0.4}, {x_m, 0.1}, height_m}}};
}

double NearestX(const std::vector<Eigen::Vector2d>& points) {
  double nearest = 100;
  for (const auto& p : points) nearest = std::min(nearest, p.x());
  return nearest;
}

class FloorMemoryTest : public testing::Test {
 protected:
  FloorMemory dut_{FloorMemoryConfig{}};
};

TEST_F(FloorMemoryTest, AThingIsKeptWhereItWasSeenThoughTheLineHasPassedIt) {
  EXPECT_TRUE(dut_.Add({kStart, {}}, {}, kStart));
  EXPECT_TRUE(dut_.Add(Line(kStart + milliseconds(500), 0.03), {0.1, 0, 0}, kStart + milliseconds(600)));
  for (int i = 0; i < 200; ++i) {
    const Time now = kStart + milliseconds(600 + 20 * i);
    EXPECT_EQ(dut_.Add({now, {}}, {0.1 + 0.005 * i, 0, 0}, now), true);
    dut_.Forget({0.1 + 0.005 * i, 0, 0}, now);
  }
  // Between the line that was clear and the one that was not.
  EXPECT_NEAR(NearestX(dut_.Points({1.1, 0, 0})), 0.92, 0.01);
}

TEST_F(FloorMemoryTest, NothingIsKnownOfTheFloorBeforeTheFirstLine) {
  EXPECT_TRUE(dut_.Add(Line(kStart, 0.03), {}, kStart));
  EXPECT_NEAR(NearestX(dut_.Points({})), 2.02 - 0.3, 0.01);
}

TEST_F(FloorMemoryTest, AHoleBeginsBeforeTheLineOnItsGround) {
  dut_.Add({kStart, {}}, {}, kStart);
  dut_.Add(Line(kStart + milliseconds(100), -0.17, 2.565), {}, kStart + milliseconds(100));
  EXPECT_NEAR(NearestX(dut_.Points({})), 2.10, 0.01);
}

TEST_F(FloorMemoryTest, AThingIsForgottenFarAway) {
  dut_.Add(Line(kStart, 0.03), {}, kStart);
  dut_.Forget({-3, 0, 0}, kStart + milliseconds(20));
  EXPECT_TRUE(dut_.Points({-3, 0, 0}).empty());
}

TEST_F(FloorMemoryTest, OldFutureAndRepeatedPicturesAreRefused) {
  EXPECT_FALSE(dut_.Add(Line(kStart, 0.03), {}, kStart + milliseconds(1500)));
  EXPECT_FALSE(dut_.Add(Line(kStart + milliseconds(500), 0.03), {}, kStart));
  EXPECT_TRUE(dut_.Points({}).empty());
  EXPECT_TRUE(dut_.Add(Line(kStart, 0.03), {}, kStart));
  EXPECT_FALSE(dut_.Add(Line(kStart, 0.03), {}, kStart));
}

}  // namespace
}  // namespace priamos::robot
