#include "robot/core/sonar/hanging_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace priamos::robot {
namespace {

const Time kNow = FromUtime(1'000'000'000);

SeenThing Table(int id = 4) {
  SeenThing thing;
  thing.id = id;
  thing.seen = kNow;
  thing.map_from_front = {2, 0, 0};
  thing.width_m = 1;
  thing.depth_m = 0.6;
  thing.bottom_m = 0.67;
  thing.top_m = 0.72;
  thing.sigma_m = 0.03;
  return thing;
}

class HangingMemoryTest : public testing::Test {
 protected:
  HangingMemory dut_{HangingConfig{}, Footprint{}};
};

TEST_F(HangingMemoryTest, TheOutlineOfATableIsKept) {
  dut_.Take(Table(), {});
  const auto points = dut_.Points({});
  ASSERT_FALSE(points.empty());
  double nearest = 9, farthest = 0, left = 0;
  for (const auto& p : points) {
    nearest = std::min(nearest, p.x());
    farthest = std::max(farthest, p.x());
    left = std::max(left, p.y());
  }
  EXPECT_NEAR(nearest, 2, 1e-9);
  EXPECT_NEAR(farthest, 2.6, 1e-9);
  EXPECT_NEAR(left, 0.5, 1e-9);
}

TEST_F(HangingMemoryTest, ItIsWhereTheMapWasWhenItWasTold) {
  dut_.Take(Table(), {1, 0, 0});
  for (const auto& p : dut_.Points({1, 0, 0})) EXPECT_GE(p.x(), 2 - 1e-9);
}

TEST_F(HangingMemoryTest, WhatSonarsHearWhatIsAboveAndWhatIsVagueDoesNotCount) {
  const auto counts = [&](auto change) {
    SeenThing thing = Table();
    change(thing);
    HangingMemory dut{HangingConfig{}, Footprint{}};
    dut.Take(thing, {});
    return !dut.Points({}).empty();
  };
  EXPECT_TRUE(counts([](SeenThing&) {}));
  EXPECT_FALSE(counts([](SeenThing& t) { t.is_edge = true; }));
  EXPECT_FALSE(counts([](SeenThing& t) { t.bottom_m = 0, t.top_m = 0.1; }));
  EXPECT_FALSE(counts([](SeenThing& t) { t.bottom_m = 1.4, t.top_m = 1.45; })) << "a lintel";
  EXPECT_FALSE(counts([](SeenThing& t) { t.top_m = 1.5; })) << "a face whose foot was not seen";
  EXPECT_FALSE(counts([](SeenThing& t) { t.sigma_m = 0.2; }));
}

TEST_F(HangingMemoryTest, ItGoesWhenTheHeadSaysSoOrNobodySawItForLong) {
  dut_.Take(Table(4), {});
  dut_.Take(Table(5), {});
  SeenThing gone = Table(4);
  gone.has_gone = true;
  dut_.Take(gone, {});
  EXPECT_FALSE(dut_.Points({}).empty()) << "the other one";
  dut_.Forget({}, kNow + std::chrono::seconds(200));
  EXPECT_FALSE(dut_.Points({}).empty());
  dut_.Forget({}, kNow + std::chrono::seconds(400));
  EXPECT_TRUE(dut_.Points({}).empty());
}

TEST_F(HangingMemoryTest, WhereTheBaseStandsNothingHangs) {
  dut_.Take(Table(), {});
  dut_.Forget({1.45, 0, 0}, kNow);
  EXPECT_FALSE(dut_.Points({1.45, 0, 0}).empty()) << "it stands before it";
  dut_.Forget({1.9, 0, 0}, kNow);
  EXPECT_TRUE(dut_.Points({1.9, 0, 0}).empty());
}

TEST_F(HangingMemoryTest, WhatIsFarAwayDoesNotMatterYet) {
  dut_.Take(Table(), {});
  EXPECT_TRUE(dut_.Points({-4, 0, 0}).empty());
}

}  // namespace
}  // namespace priamos::robot
