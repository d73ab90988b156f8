#include "world/core/generate/strew.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "world/core/generate/clutter.hpp"

namespace priamos::world {
namespace {

constexpr std::uint64_t kSeeds = 200;

PersonPlan Bystander() {
  PersonPlan person;
  person.name = "bystander";
  person.chance = 0.5;
  person.waypoints.push_back({3, 3.5, 0, 0});
  return person;
}

/// A room of 6 m by 5 m with a lane through its middle.
WorldPlan Room() {
  WorldPlan plan;
  plan.boxes.push_back({"cupboard", 4, 4.5, 0, 1, 0.4, 1.8});
  plan.free_lanes.push_back({{1, 2.5}, {5, 2.5}, 0.8});
  StrewnPlan things;
  things.high_m = {6, 5};
  things.least = 1;
  things.most = 4;
  plan.strewn.push_back(things);
  plan.people.push_back(Bystander());
  SonarFault fault;
  fault.sensor = SonarFault::kAny;
  fault.kind = "deaf";
  fault.chance = 0.25;
  plan.faults.sonars.push_back(fault);
  return plan;
}

double RadiusOf(const BoxPlan& box) {
  return std::hypot(box.length_m, box.width_m) / 2;
}

TEST(OfTheDay, NothingIsStrewnIntoTheLaneOrOntoAPlaceOfAPersonOrIntoFurniture) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const WorldPlan dut = OfTheDay(Room(), seed);
    ASSERT_GE(dut.boxes.size(), 1u);
    EXPECT_EQ(dut.boxes[0].name, "cupboard");
    for (std::size_t i = 1; i < dut.boxes.size(); ++i) {
      const BoxPlan& box = dut.boxes[i];
      const Eigen::Vector2d at(box.x_m, box.y_m);
      if (box.name == "table leg") continue;  // below its top
      EXPECT_GE(dut.free_lanes[0].DistanceTo(at), RadiusOf(box)) << seed << box.name;
      EXPECT_GE((at - Eigen::Vector2d(4, 4.5)).norm(), RadiusOf(box) + RadiusOf(dut.boxes[0])) << seed;
      if (!dut.people.empty()) {
        EXPECT_GE((at - Eigen::Vector2d(3, 3.5)).norm(), RadiusOf(box) + 0.35 - 1e-9) << seed << box.name;
      }
    }
  }
}

TEST(FreeLane, IsAStripWithRoundEnds) {
  const FreeLane dut{{1, 2.5}, {5, 2.5}, 0.8};
  EXPECT_NEAR(dut.DistanceTo({3, 2.5}), -0.8, 1e-12);
  EXPECT_NEAR(dut.DistanceTo({3, 4}), 0.7, 1e-12);
  EXPECT_NEAR(dut.DistanceTo({6, 2.5}), 0.2, 1e-12);
}

TEST(OfTheDay, EverySeedIsAnotherDayAndTheSameSeedTheSame) {
  std::set<std::string> kinds;
  std::set<double> places;
  int things = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const WorldPlan dut = OfTheDay(Room(), seed), again = OfTheDay(Room(), seed);
    ASSERT_EQ(dut.boxes.size(), again.boxes.size());
    EXPECT_EQ(dut.people.size(), again.people.size());
    for (std::size_t i = 1; i < dut.boxes.size(); ++i) {
      EXPECT_EQ(dut.boxes[i].x_m, again.boxes[i].x_m);
      kinds.insert(dut.boxes[i].name);
      if (dut.boxes[i].name == "table leg") continue;
      places.insert(dut.boxes[i].x_m);
      ++things;
    }
  }
  EXPECT_GT(things, int(kSeeds));
  EXPECT_EQ(places.size(), std::size_t(things)) << "two things at one place";
  for (const char* kind : {"carton", "cupboard", "bin", "post", "board", "glass", "table top"})
    EXPECT_TRUE(kinds.contains(kind)) << kind;
}

TEST(OfTheDay, ChanceIsThePartOfTheRuns) {
  int people = 0, faults = 0;
  std::set<int> sensors;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const WorldPlan dut = OfTheDay(Room(), seed);
    people += int(dut.people.size());
    faults += int(dut.faults.sonars.size());
    for (const SonarFault& fault : dut.faults.sonars) sensors.insert(fault.sensor);
  }
  EXPECT_NEAR(people, 200, 40);
  EXPECT_NEAR(faults, 100, 36);
  EXPECT_EQ(*sensors.begin(), 1);
  EXPECT_EQ(*sensors.rbegin(), 24);
}

TEST(OfTheDay, AThingThatFindsNoPlaceIsLeftOut) {
  WorldPlan plan = Room();
  plan.free_lanes[0].half_m = 3;
  EXPECT_EQ(OfTheDay(plan, 1).boxes.size(), 1u);
}

TEST(OfTheDay, APlanWithoutChanceIsAsItWas) {
  WorldPlan plan = Room();
  plan.strewn.clear();
  plan.people[0].chance = 1;
  plan.faults.sonars.clear();
  const WorldPlan dut = OfTheDay(plan, 7);
  EXPECT_EQ(dut.boxes.size(), 1u);
  EXPECT_EQ(dut.people.size(), 1u);
}

TEST(DrawThing, ABoardHangsAndATableHasLegs) {
  Rng rng(1);
  const BoxPlan board = DrawThing("board", rng);
  EXPECT_GE(board.bottom_m, 0.5);
  WorldPlan plan;
  AddThing("table", DrawThing("table", rng), plan);
  ASSERT_EQ(plan.boxes.size(), 5u);
  EXPECT_EQ(plan.boxes[1].height_m, plan.boxes[0].bottom_m);
  EXPECT_THROW(DrawThing("elephant", rng), std::invalid_argument);
}

}  // namespace
}  // namespace priamos::world
