#include "robot/core/sonar/mover_watch.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "common/random.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr double kNone_m = -1;
constexpr double kFront_m = 0.475;  ///< of the drawn body before its centre

class MoverWatchTest : public testing::Test {
 protected:
  /// A cycle in which the sensor straight ahead hears `range_m`, and those beside the base their walls.
  void Hear(double range_m, const Pose2& odom_from_base = {}) {
    SonarCycle cycle{now_ += milliseconds(100), {}};
    cycle.range_m.fill(kNone_m);
    cycle.range_m[0] = range_m;
    cycle.range_m[6] = cycle.range_m[18] = 0.7;
    dut_.Add(cycle, odom_from_base);
  }
  /// A person who comes from `from_m` before the base at `speed_m_s`, the base driving at `base_m_s`.
  void Come(double from_m, double speed_m_s, double base_m_s, int cycles) {
    for (int i = 0; i < cycles; ++i) {
      const double t_s = 0.1 * i, base_x = base_m_s * t_s;
      // Legs swing: what is heard comes by jerks.
      const double legs_m = 0.05 * std::sin(5 * t_s);
      Hear(from_m - speed_m_s * t_s - base_x + legs_m + rng_.Normal(0.005), {base_x, 0, 0});
    }
  }
  double NearestPoint_m(const Pose2& odom_from_base = {}) const {
    double nearest = 99;
    for (const auto& point : dut_.Points(odom_from_base)) nearest = std::min(nearest, point.x() - kFront_m);
    return nearest;
  }

  Time now_ = FromUtime(1'000'000'000);
  Rng rng_{3};
  MoverWatch dut_{MoverConfig{}, Footprint{}};
};

TEST_F(MoverWatchTest, WhoeverComesIsKnownHalfASecondAfterTheFirstEcho) {
  for (const double speed : {0.5, 0.8, 1.2})
    for (const double base : {0.0, 0.3}) {
      dut_ = MoverWatch(MoverConfig{}, Footprint{});
      Come(4, speed, base, 7);
      ASSERT_THAT(dut_.movers(), SizeIs(1)) << speed << " " << base;
      EXPECT_NEAR(-dut_.movers()[0].velocity.x(), speed, 0.3) << speed << " " << base;
    }
}

TEST_F(MoverWatchTest, WhoComesFromTheSideIsAboutToMeetTheBaseButKeepsNothingFree) {
  constexpr std::size_t kLeft = 6;  // 90 degrees
  for (int i = 0; i < 12; ++i) {
    SonarCycle cycle{now_ += milliseconds(100), {}};
    cycle.range_m.fill(kNone_m);
    cycle.range_m[kLeft] = 2.2 - 0.08 * i;
    dut_.Add(cycle, {});
  }
  ASSERT_THAT(dut_.movers(), SizeIs(1));
  EXPECT_TRUE(dut_.movers()[0].beside);
  EXPECT_TRUE(dut_.IsAboutToMeet({}, {0, 0}, 1.5)) << "1 m away at 0.8 m/s";
  EXPECT_FALSE(dut_.IsAboutToMeet({}, {0, 0}, 0.5));
  EXPECT_FALSE(dut_.IsAboutToMeet({}, {1.5, 0}, 1.5)) << "the base is gone by then";
  EXPECT_THAT(dut_.Points({}), IsEmpty());
  EXPECT_FALSE(dut_.IsOfMover(dut_.movers()[0].at));
  EXPECT_EQ(dut_.NearestAhead({}), nullptr);
}

TEST_F(MoverWatchTest, WhoHasStoppedIsNotAboutToMeetTheBase) {
  Come(3, 0.8, 0, 12);
  EXPECT_TRUE(dut_.IsAboutToMeet({}, {0, 0}, 2.5));
  for (int i = 0; i < 15; ++i) Hear(3 - 0.8 * 1.2);
  EXPECT_FALSE(dut_.IsAboutToMeet({}, {0, 0}, 2.5));
}

TEST_F(MoverWatchTest, WhatStandsDoesNotComeHoweverTheBaseDrives) {
  for (const double base : {-0.2, 0.0, 0.3, 0.6}) {
    dut_ = MoverWatch(MoverConfig{}, Footprint{});
    Come(4, 0, base, 30);
    EXPECT_THAT(dut_.movers(), IsEmpty()) << base;
  }
}

TEST_F(MoverWatchTest, AJumpFromAWallToAThingBeforeItIsNoMotion) {
  for (int i = 0; i < 20; ++i) Hear(i < 10 ? 4 : 2.5);
  for (int i = 0; i < 20; ++i) Hear(i % 2 ? 4 : 2.5);
  EXPECT_THAT(dut_.movers(), IsEmpty());
}

TEST_F(MoverWatchTest, ASlantedFaceThatABeamIsCarriedAcrossIsNoMotion) {
  // The base goes to the side: a face at 45 degrees comes as fast as the base goes, and more.
  for (int i = 0; i < 20; ++i) Hear(2 - 0.04 * i, {0, 0.025 * i, 0});
  EXPECT_THAT(dut_.movers(), IsEmpty());
}

TEST_F(MoverWatchTest, WhatWasHeardToComeAndGetsNoFartherWasAnEdge) {
  // Half a second of an edge that a beam meets, and then it stands: no strip is kept free before it for long.
  for (int i = 0; i < 6; ++i) Hear(1.6 - 0.06 * i);
  ASSERT_THAT(dut_.movers(), SizeIs(1));
  for (int i = 0; i < 11; ++i) Hear(1.3);
  EXPECT_THAT(dut_.movers(), IsEmpty());
  // Somebody who goes on, as slowly as anybody, is one, and stays one when he stops.
  Come(3, 0.5, 0, 20);
  for (int i = 0; i < 30; ++i) Hear(3 - 0.5 * 1.9);
  EXPECT_THAT(dut_.movers(), SizeIs(1));
}

TEST_F(MoverWatchTest, WhoLeavesDoesNotCome) {
  Come(1, -1.0, 0, 20);
  EXPECT_THAT(dut_.movers(), IsEmpty());
}

TEST_F(MoverWatchTest, BeamsThatSweepOverAWallWhileTheBaseTurnsAreNoMotion) {
  for (int i = 0; i < 20; ++i) Hear(3 - 0.06 * i, {0, 0, 0.04 * i});
  EXPECT_THAT(dut_.movers(), IsEmpty());
}

TEST_F(MoverWatchTest, TheStripThatWillBeWalkedOverIsKeptFreeAndItIsLongerForWhoWalksFaster) {
  Come(4, 0.5, 0, 10);
  const double slowly = 4 - 0.45 - NearestPoint_m();
  dut_ = MoverWatch(MoverConfig{}, Footprint{});
  Come(4, 1.2, 0, 10);
  const double fast = 4 - 1.08 - NearestPoint_m();
  EXPECT_GT(slowly, 0.28 + 0.3 * 1.2);
  EXPECT_GT(fast, slowly + 0.3);
  EXPECT_LT(fast, 0.4 + 1.6 * 1.2);
}

TEST_F(MoverWatchTest, WhoStopsIsKeptOffForAWhileAndIsAnOrdinaryThingThen) {
  dut_ = MoverWatch(MoverConfig{.standing_s = 10}, Footprint{});
  Come(3, 1.0, 0, 15);
  for (int i = 0; i < 20; ++i) Hear(1.6);
  ASSERT_THAT(dut_.movers(), SizeIs(1));
  EXPECT_LT(NearestPoint_m(), 1.6 - 0.2);
  EXPECT_GT(NearestPoint_m(), 1.6 - 0.4) << "no strip before who stands";
  EXPECT_TRUE(dut_.IsOfMover({kFront_m + 1.6, 0}));
  EXPECT_FALSE(dut_.IsOfMover({kFront_m + 0.6, 0}));
  for (int i = 0; i < 120; ++i) Hear(1.6);
  EXPECT_THAT(dut_.movers(), IsEmpty());
}

TEST_F(MoverWatchTest, WhoIsNotHeardAnyMoreIsForgotten) {
  Come(3, 1.0, 0, 15);
  for (int i = 0; i < 15; ++i) Hear(kNone_m);
  EXPECT_THAT(dut_.movers(), IsEmpty());
}

TEST_F(MoverWatchTest, NoPlaceThatIsKeptFreeLiesInTheBase) {
  Come(2, 1.2, 0, 15);
  ASSERT_THAT(dut_.Points({}), Not(IsEmpty()));
  for (const auto& point : dut_.Points({})) EXPECT_GT(Footprint{}.Distance(point), 0);
}

}  // namespace
}  // namespace priamos::robot
