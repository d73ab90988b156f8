#include "planner/core/locate/leg_choice.hpp"

#include <gmock/gmock.h>

#include "simulated_drive.hpp"

namespace priamos::planner {
namespace {

DrivenWay Standing() {
  DrivenWay way;
  way.trail = {{0, 0, 0}};
  return way;
}

HeardPiece PieceAt(double x_m, double y_m, double yaw_deg, double length_m) {
  return {{x_m, y_m, Radians(yaw_deg)}, length_m};
}

TEST(LegChoice, TheFirstLegLeadsAhead) {
  const auto dut = ChooseLeg({}, Standing(), {});
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->x, 2, 1e-9);
  EXPECT_NEAR(dut->y, 0, 1e-9);
}

TEST(LegChoice, ALegEndsBeforeAWallThatWasHeard) {
  DrivenWay way = Standing();
  way.pieces = {PieceAt(2, 0, 90, 2)};
  const auto dut = ChooseLeg({}, way, {});
  ASSERT_TRUE(dut);
  EXPECT_LT(dut->x, 1.3);
}

TEST(LegChoice, WhereTheWayIsClosedItLeadsElsewhere) {
  const auto dut = ChooseLeg({}, Standing(), {{{{0, 0}, {1, 0}}}});
  ASSERT_TRUE(dut);
  EXPECT_NEAR(std::abs(dut->y), 2, 1e-9);
}

TEST(LegChoice, LegsFollowTheDirectionOfTheWalls) {
  DrivenWay way = Standing();
  way.pieces = {PieceAt(0, -1, 30, 2)};
  const auto dut = ChooseLeg({}, way, {});
  ASSERT_TRUE(dut);
  EXPECT_NEAR(std::remainder(std::atan2(dut->y, dut->x) - Radians(30), kPi / 2), 0, 1e-6);
}

TEST(LegChoice, AWayThatLeadsOnGetsLonger) {
  DrivenWay way = Standing();
  for (int i = 0; i <= 20; ++i) way.trail.push_back({0.2 * i, 0, 0});
  const auto dut = ChooseLeg({}, way, {});
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->x, 10, 1e-9);
}

TEST(LegChoice, WhereAllIsClosedThereIsNone) {
  std::vector<ClosedWay> closed;
  for (int eighth = 0; eighth < 8; ++eighth)
    closed.push_back({{0, 0}, {std::cos(eighth * kPi / 4), std::sin(eighth * kPi / 4)}});
  EXPECT_FALSE(ChooseLeg({}, Standing(), {closed}));
}

/// 4 m ahead, in all directions closed at the end.
DrivenWay ThereAndClosed(std::vector<ClosedWay>& closed) {
  DrivenWay way = Standing();
  for (int i = 1; i <= 20; ++i) way.trail.push_back({0.2 * i, 0, 0});
  for (int eighth = 0; eighth < 8; ++eighth)
    closed.push_back({{4, 0}, {std::cos(eighth * kPi / 4), std::sin(eighth * kPi / 4)}});
  return way;
}

TEST(WayBack, WhereNoLegBeginsItLeadsToAPlaceFromWhichOneDoes) {
  std::vector<ClosedWay> closed;
  const DrivenWay way = ThereAndClosed(closed);
  ASSERT_FALSE(ChooseLeg({}, way, {closed}));
  const auto dut = ChooseWayBack({}, way, {closed});
  ASSERT_FALSE(dut.empty());
  EXPECT_LT(dut.back().x, 3.65);
  EXPECT_NEAR(dut.back().y, 0, 1e-9);
  // Not farther back than it has to be.
  EXPECT_GT(dut.back().x, 3.0);
}

TEST(WayBack, WhereAllAroundTheWayIsKnownThereIsNone) {
  std::vector<ClosedWay> closed;
  DrivenWay way = ThereAndClosed(closed);
  for (const double side_m : {-0.9, 0.9}) way.pieces.push_back(PieceAt(2, side_m, 0, 6));
  for (const double end_m : {-0.9, 4.9}) way.pieces.push_back(PieceAt(end_m, 0, 90, 3));
  EXPECT_TRUE(ChooseWayBack({}, way, {closed}).empty());
}

TEST(AlongTrail, ACornerOfTheWayIsKept) {
  std::vector<Pose2> trail;
  for (int i = 0; i <= 10; ++i) trail.push_back({0.2 * i, 0, 0});
  for (int i = 1; i <= 10; ++i) trail.push_back({2, 0.2 * i, 0});
  const auto dut = AlongTrail(trail, trail.size() - 1, 0);
  ASSERT_EQ(dut.size(), 2U);
  EXPECT_NEAR((dut[0].translation() - Eigen::Vector2d(2, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR(dut[1].translation().norm(), 0, 1e-9);
}

TEST(AlongTrail, AStraightWayIsOneLine) {
  std::vector<Pose2> trail;
  for (int i = 0; i <= 10; ++i) trail.push_back({0.2 * i, 0.01 * (i % 2), 0});
  EXPECT_EQ(AlongTrail(trail, 0, 10).size(), 1U);
}

TEST(LegChoice, NoLegLeadsThroughWhatStoppedTheBase) {
  LegHints hints;
  hints.things = {{{1.2, 0.1, 0}, {0.2, 0.2}}};
  const auto dut = ChooseLeg({}, Standing(), hints);
  ASSERT_TRUE(dut);
  EXPECT_GT(std::abs(dut->y), 1);
}

TEST(LegChoice, TheBaseTurnsAlongAWallOfWhichMuchWasHeard) {
  DrivenWay way = Standing();
  way.pieces = {PieceAt(0, -1.5, 30, 2)};
  EXPECT_NEAR(ChooseLeg({}, way, {})->yaw, Radians(30), 1e-9);
  way.pieces = {PieceAt(0, -1.5, 30, 1)};
  EXPECT_NEAR(ChooseLeg({}, way, {})->yaw, 0, 1e-9);
}

/// A room, and another one that is longer.
GroundPlan TwoRooms() {
  GroundPlan plan;
  AddRoom(plan, {0, 0}, {4, 5});
  AddRoom(plan, {4.14, 0}, {8, 5});
  return plan;
}

TEST(LegChoice, ALegThatIsLongerThanOneOfThePlacesAllowsIsWorthMore) {
  const PlacePlan plan(TwoRooms());
  LegHints hints;
  // Along x the first room ends 1 m before the base, the other one 5 m.
  hints.rivals = {{3, 2.5, 0}, {7.14, 2.5, 0}};
  hints.plan = &plan;
  DrivenWay way = Standing();
  way.trail = {{0, 0, kPi / 2}};  // alone, it would go on along y
  ASSERT_GT(ChooseLeg({}, way, {})->y, 1);
  const auto dut = ChooseLeg({}, way, hints);
  ASSERT_TRUE(dut);
  EXPECT_GT(dut->x, 2.1);
  EXPECT_NEAR(dut->y, 0, 1e-6);
}

TEST(LegChoice, AWayWithoutLoopsLeadsBackPastWhereTheBaseWentToAndFro) {
  std::vector<Pose2> trail;
  for (int i = 0; i <= 5; ++i) trail.push_back({0.2 * i, 0, 0});
  for (int n = 0; n < 4; ++n)
    for (const double x_m : {0.8, 0.6, 0.8, 1.0}) trail.push_back({x_m, 0.03, 0.05});
  const auto dut = WithoutLoops(trail);
  EXPECT_LE(dut.size(), 7U);
  EXPECT_EQ(dut.front().x, 0);
  EXPECT_EQ(dut.back().x, 1);
}

}  // namespace
}  // namespace priamos::planner
