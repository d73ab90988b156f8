#include "world/core/motion/movers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "world/core/scene/build_solids.hpp"

namespace priamos::world {
namespace {

const Rectangle kFarAway{{50, 50, 0}, {0.475, 0.39}};

MovedLeaf LeafThatCloses() {
  MovedLeaf leaf;
  leaf.door.name = "lab";
  leaf.hinge = "left";
  leaf.solid = LeafName(leaf.door);
  leaf.swings = {{1, 0, 90}};
  return leaf;
}

std::vector<Solid> DoorAt(double open_deg) {
  DoorWork work;
  return DoorSolids(LeafThatCloses().door, work, open_deg);
}

Solid LeafAt(double open_deg) {
  const auto solids = DoorAt(open_deg);
  return *std::find_if(solids.begin(), solids.end(), [](const Solid& s) { return s.name == "lab: leaf"; });
}

TEST(SwingingLeafTest, TurnsWhenItsTimeHasComeAndStandsBefore) {
  const auto solids = DoorAt(100);
  Movers dut({}, {LeafThatCloses()}, solids, 1);
  EXPECT_NEAR(dut.leaves()[0].open_deg(), 100, 1e-6);
  dut.Step(0.5, 0.5, kFarAway);
  EXPECT_NEAR(dut.leaves()[0].open_deg(), 100, 1e-6);
  for (double t = 1; t < 1.5; t += 0.01) dut.Step(t, 0.01, kFarAway);
  EXPECT_NEAR(dut.leaves()[0].open_deg(), 55, 2);
  for (double t = 1.5; t < 3; t += 0.01) dut.Step(t, 0.01, kFarAway);
  EXPECT_EQ(dut.leaves()[0].open_deg(), 0);
  const Pose2 closed = dut.moved()[0].map_from_solid;
  EXPECT_NEAR(closed.x, LeafAt(0).map_from_solid.x, 1e-9);
}

TEST(SwingingLeafTest, StopsAtTheRobotAndDoesNotCutIt) {
  Movers dut({}, {LeafThatCloses()}, DoorAt(100), 1);
  const Rectangle robot{{0.5, 0, 0}, {0.475, 0.39}};
  for (double t = 1; t < 4; t += 0.0025) dut.Step(t, 0.0025, robot);
  EXPECT_GT(dut.leaves()[0].open_deg(), 40);
  const double gap_m = Distance(Rectangle{dut.moved()[0].map_from_solid, LeafAt(0).size_m / 2}, robot);
  EXPECT_GT(gap_m, 0);
  EXPECT_LT(gap_m, 0.0005) << "a touch";
}

TEST(MoversTest, PeopleComeAfterAllOtherSolids) {
  PersonPlan plan;
  plan.name = "visitor";
  plan.waypoints = {{3, 3, 0, 0}, {3, 5, 0, 0}};
  const auto solids = WithPeople(DoorAt(90), {plan});
  ASSERT_EQ(solids.size(), DoorAt(90).size() + kBodyParts);
  EXPECT_EQ(solids.back().name, "visitor: right foot");
  Movers dut({plan}, {}, solids, 1);
  ASSERT_EQ(dut.moved().size(), kBodyParts);
  EXPECT_EQ(dut.moved().back().solid, solids.size() - 1);
  for (int i = 0; i < 400; ++i) dut.Step(i * 0.0025, 0.0025, kFarAway);
  EXPECT_NEAR(dut.moved()[2].map_from_solid.y, 3.8, 0.05) << "its trunk";
}

TEST(MoversTest, ALeafThatIsNotThereIsAnError) {
  EXPECT_THROW(Movers({}, {LeafThatCloses()}, {}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace priamos::world
