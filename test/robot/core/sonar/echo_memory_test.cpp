#include "robot/core/sonar/echo_memory.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "robot/core/safety/collision_stop.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::Not;

constexpr Time kStart = FromUtime(1'000'000'000);

class EchoMemoryTest : public testing::Test {
 protected:
  /// A cycle in which only the given sensors hear something.
  static SonarCycle Cycle(int index, const std::map<int, double>& echoes) {
    SonarCycle cycle{.time = kStart + index * milliseconds(100)};
    cycle.range_m.fill(-1);
    for (const auto& [sensor, range] : echoes) cycle.range_m[static_cast<std::size_t>(sensor)] = range;
    return cycle;
  }
  void Add(int index, const std::map<int, double>& echoes, const Pose2& at = {}) {
    dut_.Add(Cycle(index, echoes), at);
  }

  EchoMemory dut_{EchoMemoryConfig{}, Footprint{}};
};

TEST_F(EchoMemoryTest, KnowsNothingBeforeTheFirstCycle) {
  EXPECT_FALSE(dut_.newest());
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

TEST_F(EchoMemoryTest, ASingleEchoIsNotBelieved) {
  Add(0, {{0, 1.0}});
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

TEST_F(EchoMemoryTest, TwoOfThreeCyclesAreBelieved) {
  Add(0, {{0, 1.0}});
  Add(1, {});
  Add(2, {{0, 0.9}});
  EXPECT_THAT(dut_.Points({}), Not(IsEmpty()));
}

TEST_F(EchoMemoryTest, TwoEchoesThatDisagreeAreNotBelieved) {
  Add(0, {{0, 1.0}});
  Add(1, {{0, 2.5}});
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

TEST_F(EchoMemoryTest, ANeighbourInTheSameCycleConfirms) {
  Add(0, {{23, 1.0}, {0, 1.1}});
  EXPECT_THAT(dut_.Points({}), Not(IsEmpty()));
}

TEST_F(EchoMemoryTest, AVeryNearEchoCountsAtOnce) {
  Add(0, {{0, 0.2}});
  EXPECT_THAT(dut_.Points({}), Not(IsEmpty()));
}

TEST_F(EchoMemoryTest, AnEchoLiesOnTheArcOfItsCone) {
  Add(0, {{0, 1.0}});
  Add(1, {{0, 1.0}});
  const Eigen::Vector2d sensor(0.475, 0);
  double widest = 0;
  for (const Eigen::Vector2d& point : dut_.Points({})) {
    EXPECT_NEAR((point - sensor).norm(), 1.0, 1e-9);
    widest = std::max(widest, std::abs(point.y()));
  }
  EXPECT_NEAR(widest, std::sin(Radians(7.5)), 1e-9);
}

TEST_F(EchoMemoryTest, BetweenNearEchoesOfNeighboursLiesAThing) {
  Add(0, {{21, 0.20}, {22, 0.20}});  // on both sides of the corner on the right in front
  const auto bridges = dut_.Bridges({});
  ASSERT_THAT(bridges, Not(IsEmpty()));
  // In the wedge before the corner that no arc reaches.
  EXPECT_TRUE(std::any_of(bridges.begin(), bridges.end(), [](const Eigen::Vector2d& p) {
    return p.x() > 0.54 && p.x() < 0.63 && p.y() < -0.37 && p.y() > -0.52;
  }));
}

/// What a monkey found: he turned the base about the corner of an armchair, whose faces were seen on both
/// sides of the base's corner and whose own corner by nobody.
TEST_F(EchoMemoryTest, ABridgeStopsAMotionThatArcsDoNot) {
  const CollisionStop guard({.margin_m = 0.055}, Footprint{});
  const Twist2 round{0.03, -0.077, 0.19};
  for (int cycle = 0; cycle < 3; ++cycle) Add(cycle, {{20, 0.23}, {21, 0.11}, {22, 0.30}});
  auto points = dut_.Points({});
  EXPECT_EQ(guard.Limit(round, points, {}).scale, 1);
  const auto bridges = dut_.Bridges({});
  points.insert(points.end(), bridges.begin(), bridges.end());
  EXPECT_LT(guard.Limit(round, points, {}).scale, 0.3);
}

TEST_F(EchoMemoryTest, FarEchoesOrThoseFarApartAreNotBridged) {
  Add(0, {{3, 0.8}, {4, 0.8}});     // far
  Add(1, {{10, 0.15}, {11, 0.6}});  // one of them far
  Add(2, {{17, 0.2}, {19, 0.2}});   // no neighbours
  EXPECT_THAT(dut_.Bridges({}), IsEmpty());
}

TEST_F(EchoMemoryTest, AnEchoAtTheLeastDistanceMayComeFromNearer) {
  Add(0, {{0, 0.1}});
  for (const Eigen::Vector2d& point : dut_.Points({})) EXPECT_LT(point.x(), 0.475 + 0.06);
}

TEST_F(EchoMemoryTest, ANewerEchoOfTheSameSensorReplacesTheOlder) {
  Add(0, {{0, 1.0}});
  Add(1, {{0, 1.0}});
  Add(2, {{0, 1.2}});
  for (const Eigen::Vector2d& point : dut_.Points({})) EXPECT_GT(point.x(), 0.475 + 1.15);
}

TEST_F(EchoMemoryTest, ARememberedEchoStaysWhereItWasWhenTheBaseMoves) {
  Add(0, {{0, 1.0}});
  Add(1, {{0, 1.0}});
  double nearest = 9;
  for (const Eigen::Vector2d& point : dut_.Points({0.2, 0, 0})) nearest = std::min(nearest, point.x());
  EXPECT_NEAR(nearest, 0.475 + std::cos(Radians(7.5)) - 0.2, 1e-9);
}

TEST_F(EchoMemoryTest, EchoesAreForgottenWithTheirCycle) {
  Add(0, {{0, 1.0}});
  Add(1, {{0, 1.0}});
  dut_.Forget({}, kStart + milliseconds(500));
  EXPECT_THAT(dut_.Points({}), IsEmpty());
  EXPECT_FALSE(dut_.newest());
}

TEST_F(EchoMemoryTest, ANearThingIsRememberedWhenNoBeamSeesItAnyMore) {
  Add(0, {{0, 0.3}});
  Add(1, {{0, 0.3}});
  Add(2, {});
  dut_.Forget({}, kStart + milliseconds(1000));
  EXPECT_THAT(dut_.Points({}), IsEmpty());
  const auto remembered = dut_.Remembered({0.1, 0, 0});
  ASSERT_EQ(remembered.size(), 1u);
  EXPECT_NEAR(remembered[0].x(), 0.475 + 0.3 - 0.1, 1e-9);
}

TEST_F(EchoMemoryTest, NonsenseIsNoEcho) {
  for (int i = 0; i < 3; ++i)
    Add(i, {{0, std::numeric_limits<double>::quiet_NaN()}, {1, 7.0}, {2, -0.5}, {3, HUGE_VAL}});
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

}  // namespace
}  // namespace priamos::robot
