#include "world/core/motion/person.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace priamos::world {
namespace {

constexpr double kStep_s = 0.0025;
const Rectangle kFarAway{{50, 50, 0}, {0.475, 0.39}};

PersonPlan Walker(double speed_m_s = 1) {
  PersonPlan plan;
  plan.speed_m_s = speed_m_s;
  plan.waypoints = {{0, 0, 0, 0}, {4, 0, 1, 0}};
  return plan;
}

Eigen::Vector2d PlaceOf(const Person& person) {
  return person.posture().map_from_person.translation();
}

/// Lets time pass; returns the nearest that any part of the body came to the robot.
double Walk(Person& person, double seconds, const Around& around) {
  double nearest = 100;
  for (double t = 0; t < seconds; t += kStep_s) {
    person.Step(kStep_s, around);
    for (const Solid& part : SolidsOf("p", person.posture()))
      nearest = std::min(nearest, Distance(Rectangle{part.map_from_solid, part.size_m / 2}, around.robot));
  }
  return nearest;
}

TEST(PersonTest, WalksToTheWaypointAtTheStatedSpeedAndWaitsThere) {
  Person dut(Walker(), Rng(1));
  Walk(dut, 2, {kFarAway, {}});
  EXPECT_NEAR(PlaceOf(dut).x(), 2, 0.02);
  Walk(dut, 2.2, {kFarAway, {}});
  const double there = PlaceOf(dut).x();
  EXPECT_NEAR(there, 4, 0.16);
  Walk(dut, 0.4, {kFarAway, {}});
  EXPECT_EQ(PlaceOf(dut).x(), there);
  Walk(dut, 3, {kFarAway, {}});
  EXPECT_LT(PlaceOf(dut).x(), 3) << "on the way back";
}

TEST(PersonTest, StandsAtASingleWaypoint) {
  PersonPlan plan;
  plan.waypoints = {{1, 2, 0, 0}};
  Person dut(plan, Rng(1));
  Walk(dut, 5, {kFarAway, {}});
  EXPECT_EQ(PlaceOf(dut), Eigen::Vector2d(1, 2));
}

TEST(PersonTest, LegsSwingAgainstEachOther) {
  Person dut(Walker(), Rng(1));
  double widest = 0;
  for (int i = 0; i < 400; ++i) {
    dut.Step(kStep_s, {kFarAway, {}});
    const auto parts = PartPoses(dut.posture());
    widest = std::max(widest, std::abs(parts[0].x - parts[1].x));
  }
  EXPECT_NEAR(widest, 0.30, 0.01);
}

TEST(PersonTest, WhoStandsBeforeTheRobotHasTheFeetSideBySide) {
  for (const double start : {0.0, 0.15, 0.3, 0.45}) {
    PersonPlan plan = Walker();
    plan.waypoints[0].x_m = start;
    Person dut(plan, Rng(1));
    const Around corridor{Rectangle{{2, 0, 0}, {0.475, 0.39}},
                          {Rectangle{{2, 0.8, 0}, {5, 0.1}}, Rectangle{{2, -0.8, 0}, {5, 0.1}}}};
    Walk(dut, 3, corridor);
    const auto parts = PartPoses(dut.posture());
    EXPECT_NEAR((parts[4].Inverse() * parts[5]).x, 0, 1e-6) << start;
  }
}

TEST(PersonTest, AnAttentiveOneWalksAroundAStandingRobot) {
  Person dut(Walker(), Rng(1));
  const double nearest = Walk(dut, 6, {Rectangle{{2, 0.1, 0}, {0.475, 0.39}}, {}});
  EXPECT_GT(nearest, 0.02);
  EXPECT_GT(PlaceOf(dut).x(), 3.2);
}

TEST(PersonTest, AnAttentiveOneStopsWhereThereIsNoWayAroundAndGivesUp) {
  Person dut(Walker(), Rng(1));
  const Around corridor{Rectangle{{2, 0, 0}, {0.475, 0.39}},
                        {Rectangle{{2, 0.8, 0}, {5, 0.1}}, Rectangle{{2, -0.8, 0}, {5, 0.1}}}};
  EXPECT_GT(Walk(dut, 5, corridor), 0.02);
  EXPECT_LT(PlaceOf(dut).x(), 1.4);
  Walk(dut, 3, corridor);
  EXPECT_LT(PlaceOf(dut).x(), 0.6) << "turned back";
}

TEST(PersonTest, AnInattentiveOneWalksIntoTheRobotAndTurnsBack) {
  PersonPlan plan = Walker();
  plan.attentive = false;
  Person dut(plan, Rng(1));
  const Around around{Rectangle{{2, 0, 0}, {0.475, 0.39}}, {}};
  EXPECT_LT(Walk(dut, 2, around), 0.0005);
  EXPECT_NEAR(PlaceOf(dut).x(), 1.2, 0.25);
  double back_m = PlaceOf(dut).x();
  for (int i = 0; i < 40; ++i) {
    Walk(dut, 0.1, around);
    back_m = std::min(back_m, PlaceOf(dut).x());
  }
  EXPECT_LT(back_m, 0.8);
}

RC_GTEST_PROP(PersonTest, NeverWalksThroughTheRobot, ()) {
  PersonPlan plan = Walker(*rc::gen::inRange(2, 13) / 10.0);
  plan.attentive = *rc::gen::arbitrary<bool>();
  const Rectangle robot{{2, *rc::gen::inRange(-60, 60) / 100.0, *rc::gen::inRange(-314, 314) / 100.0},
                        {0.475, 0.39}};
  Person dut(plan, Rng(3));
  Walk(dut, 4, {robot, {}});
  const Posture& posture = dut.posture();
  for (const Solid& part : SolidsOf("p", posture))
    RC_ASSERT(Distance(robot, part.map_from_solid.translation()) > 0.05);
}

TEST(DrawPersonTest, StaysWithinItsSpreadsAndTheSeedDecides) {
  PersonPlan plan = Walker(1.1);
  plan.speed_spread_m_s = 0.5;
  plan.spread_m = 0.3;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const PersonPlan dut = DrawPerson(plan, seed);
    EXPECT_LE(dut.speed_m_s, 1.2);
    EXPECT_GE(dut.speed_m_s, 0.6);
    EXPECT_LE(std::abs(dut.waypoints[1].x_m - 4), 0.3);
    EXPECT_EQ(dut.speed_m_s, DrawPerson(plan, seed).speed_m_s);
  }
}

}  // namespace
}  // namespace priamos::world
