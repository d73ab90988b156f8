#include "world/core/scene/build_solids.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "common/archive.hpp"
#include "common/rectangle.hpp"
#include "world/core/scene/outline.hpp"

namespace priamos::world {
namespace {

GroundPlan OneWallOneDoor() {
  GroundPlan map;
  map.walls.push_back({"front", {6, -3}, {6, 3}, 0.14});
  DoorPlan door;
  door.name = "lab";
  door.x_m = 6;
  map.doors.push_back(door);
  return map;
}

WorldPlan WithLeaf(double open_deg, const std::string& hinge = "left") {
  WorldPlan plan;
  DoorWork work;
  work.open_deg = open_deg;
  work.hinge = hinge;
  plan.doors.push_back(work);
  return plan;
}

const Solid* Find(const std::vector<Solid>& solids, const std::string& name) {
  const auto it = std::find_if(solids.begin(), solids.end(), [&](const Solid& s) { return s.name == name; });
  return it == solids.end() ? nullptr : &*it;
}

/// Free distance to the left and right of the point on the door's x axis, at robot height.
double FreeHalfWidth(const std::vector<Solid>& solids, const Eigen::Vector2d& at) {
  double nearest = 10;
  for (const auto& solid : solids)
    if (Overlaps(solid, 0.02, 1.35)) nearest = std::min(nearest, Distance(OutlineOf(solid), at));
  return nearest;
}

TEST(BuildSolidsTest, TheOpeningIsExactlyAsWideAsTheMapSays) {
  const auto solids = BuildSolids(OneWallOneDoor(), WithLeaf(100), 1);
  EXPECT_NEAR(FreeHalfWidth(solids, {6, 0}), 0.45, 1e-9);
  // Up to the stop; behind it the rebate is wider.
  EXPECT_NEAR(FreeHalfWidth(solids, {6.029, 0}), 0.45, 1e-9);
}

TEST(BuildSolidsTest, FrameStandsBeforeTheWallAndHasARebate) {
  const auto solids = BuildSolids(OneWallOneDoor(), WithLeaf(100), 1);
  const Solid* jamb = Find(solids, "lab: left jamb");
  ASSERT_TRUE(jamb);
  const Rectangle outline = OutlineOf(*jamb);
  EXPECT_NEAR(outline.map_from_centre.x - outline.half_m.x(), 6 - 0.085, 1e-9);
  EXPECT_NEAR(outline.map_from_centre.x + outline.half_m.x(), 6.03, 1e-9);
  EXPECT_NEAR(outline.map_from_centre.y + outline.half_m.y(), 0.51, 1e-9);
  const Solid* rebate = Find(solids, "lab: right rebate");
  ASSERT_TRUE(rebate);
  EXPECT_NEAR(rebate->map_from_solid.y + rebate->size_m.y() / 2, -0.465, 1e-9);
}

TEST(BuildSolidsTest, AWallDrawnThroughTheDoorEndsAtTheFrame) {
  const auto solids = BuildSolids(OneWallOneDoor(), WithLeaf(100), 1);
  const Solid* first = Find(solids, "wall front");
  const Solid* second = Find(solids, "wall front 2");
  ASSERT_TRUE(first && second);
  EXPECT_NEAR(first->map_from_solid.y + first->size_m.x() / 2, -0.51, 1e-9);
  EXPECT_NEAR(second->map_from_solid.y - second->size_m.x() / 2, 0.51, 1e-9);
}

TEST(BuildSolidsTest, AMapWhoseWallsEndAtTheOpeningGivesTheSameRoom) {
  GroundPlan split = OneWallOneDoor();
  split.walls = {{"right", {6, -3}, {6, -0.45}, 0.14}, {"left", {6, 0.45}, {6, 3}, 0.14}};
  const auto solids = BuildSolids(split, WithLeaf(100), 1);
  EXPECT_NEAR(FreeHalfWidth(solids, {6, 0}), 0.45, 1e-9);
  EXPECT_TRUE(Find(solids, "lab: wall above"));
  EXPECT_NEAR(Find(solids, "wall right")->size_m.x(), 3 - 0.51, 1e-9);
}

RC_GTEST_PROP(DoorSolidsProperty, AnOpenLeafLeavesTheWholeOpeningFree, ()) {
  const double open_deg = *rc::gen::inRange(90, 176);
  const auto solids =
      BuildSolids(OneWallOneDoor(), WithLeaf(open_deg, *rc::gen::element<std::string>("left", "right")), 1);
  for (double x = 5; x < 7.2; x += 0.02) RC_ASSERT(FreeHalfWidth(solids, {x, 0}) >= 0.45 - 1e-9);
}

RC_GTEST_PROP(DoorSolidsProperty, TheLeafNeverCutsIntoFrameOrWall, ()) {
  const double open_deg = *rc::gen::inRange(0, 176);
  const auto solids =
      BuildSolids(OneWallOneDoor(), WithLeaf(open_deg, *rc::gen::element<std::string>("left", "right")), 1);
  const Solid* leaf = Find(solids, "lab: leaf");
  RC_ASSERT(leaf);
  for (const auto& solid : solids) {
    if (&solid == leaf || solid.material == "metal" || solid.z_min_m >= leaf->z_max_m) continue;
    // Closed, it lies flat against the stop; a leaf is allowed to touch, not to sink in.
    Rectangle thinner = OutlineOf(*leaf);
    thinner.half_m -= Eigen::Vector2d::Constant(0.0005);
    if (solid.z_min_m < leaf->z_max_m && solid.name.find("lintel") == std::string::npos)
      RC_ASSERT(Distance(thinner, OutlineOf(solid)) > 0);
  }
}

TEST(BuildSolidsTest, AClosedLeafBlocksTheWay) {
  EXPECT_EQ(FreeHalfWidth(BuildSolids(OneWallOneDoor(), WithLeaf(0), 1), {6.05, 0}), 0);
}

TEST(BuildSolidsTest, ADoorThatTheWorldDoesNotListHasNoLeaf) {
  EXPECT_FALSE(Find(BuildSolids(OneWallOneDoor(), WorldPlan{}, 1), "lab: leaf"));
}

TEST(BuildSolidsTest, ADoorBuiltElsewhereTakesTheWallWithIt) {
  WorldPlan plan = WithLeaf(100);
  plan.doors[0].built_dy_m = 0.2;
  const auto solids = BuildSolids(OneWallOneDoor(), plan, 1);
  EXPECT_NEAR(FreeHalfWidth(solids, {6, 0.2}), 0.45, 1e-9);
  EXPECT_NEAR(FreeHalfWidth(solids, {6, 0}), 0.25, 1e-9);
}

/// Nothing shows where the plan is wrong: no gap beside the frame, and no crease in the wall above it.
TEST(BuildSolidsTest, TheWallOfADoorBuiltElsewhereGoesStraightOn) {
  for (const double dy_m : {-0.09, 0.09}) {
    GroundPlan map = OneWallOneDoor();
    map.walls[0] = {"right", {6, -3}, {6, -0.45}, 0.14};
    map.walls.push_back({"left", {6, 0.45}, {6, 3}, 0.14});
    WorldPlan plan = WithLeaf(100);
    plan.doors[0].built_dx_m = 0.08;
    plan.doors[0].built_dy_m = dy_m;
    plan.doors[0].built_dyaw_deg = 3;
    const auto solids = BuildSolids(map, plan, 1);
    const Pose2 door{6.08, dy_m, Radians(3)};
    for (const char* name : {"wall right", "wall left"}) {
      const Solid* wall = Find(solids, name);
      ASSERT_TRUE(wall);
      const Pose2 in_door = door.Inverse() * wall->map_from_solid;
      EXPECT_NEAR(in_door.x, 0, 1e-9) << "in the plane of the door";
      EXPECT_NEAR(std::abs(std::sin(in_door.yaw)), 1, 1e-9);
      EXPECT_NEAR(std::abs(in_door.y) - wall->size_m.x() / 2, 0.51, 1e-9) << "up to the frame";
    }
  }
}

TEST(BuildSolidsTest, TheThresholdIsLowEnoughToRollOver) {
  const auto solids = BuildSolids(OneWallOneDoor(), WithLeaf(100), 1);
  ASSERT_TRUE(Find(solids, "lab: threshold"));
  EXPECT_FALSE(Overlaps(*Find(solids, "lab: threshold"), 0.02, 1.35));
}

TEST(BuildSolidsTest, SkirtingRunsAlongBothFacesAndStopsAtTheFrame) {
  const auto solids = BuildSolids(OneWallOneDoor(), WithLeaf(100), 1);
  int boards = 0;
  for (const auto& solid : solids) {
    if (solid.material != "skirting") continue;
    ++boards;
    EXPECT_EQ(solid.z_max_m, 0.08);
    EXPECT_NEAR(std::abs(solid.map_from_solid.x - 6), 0.076, 1e-9);
    EXPECT_GE(std::abs(solid.map_from_solid.y) - solid.size_m.x() / 2, 0.51 - 1e-9);
  }
  EXPECT_EQ(boards, 4);
}

TEST(BuildSolidsTest, APosterHangsOnTheChosenFace) {
  WorldPlan plan = WithLeaf(100);
  plan.posters = {{"front", "left", 1.0, 1.1, 0.6, 0.8, "poster"},
                  {"front", "right", 1.0, 1.1, 0.6, 0.8, "poster"}};
  const auto solids = BuildSolids(OneWallOneDoor(), plan, 1);
  // The wall runs towards +y, so its left face looks to -x.
  EXPECT_NEAR(Find(solids, "poster on front")->map_from_solid.x, 6 - 0.072, 1e-9);
  EXPECT_NEAR(Find(solids, "poster on front 2")->map_from_solid.x, 6 + 0.072, 1e-9);
  EXPECT_NEAR(Find(solids, "poster on front")->map_from_solid.y, -2, 1e-9);
}

TEST(BuildSolidsTest, FurnitureStaysWithinItsSpreadAndTheSeedDecides) {
  WorldPlan plan;
  BoxPlan box;
  box.x_m = 2;
  box.spread_m = 0.3;
  plan.boxes = {box};
  std::set<double> places;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto solids = BuildSolids(OneWallOneDoor(), plan, seed);
    const double x = Find(solids, "box")->map_from_solid.x;
    EXPECT_LE(std::abs(x - 2), 0.3);
    EXPECT_EQ(x, Find(BuildSolids(OneWallOneDoor(), plan, seed), "box")->map_from_solid.x);
    places.insert(x);
  }
  EXPECT_EQ(places.size(), 50u);
}

TEST(BuildSolidsTest, NamesAreUnique) {
  WorldPlan plan = WithLeaf(100);
  plan.boxes = {BoxPlan{}, BoxPlan{}, BoxPlan{}};
  std::set<std::string> names;
  for (const auto& solid : BuildSolids(OneWallOneDoor(), plan, 1))
    EXPECT_TRUE(names.insert(solid.name).second) << solid.name;
}

std::string ErrorOf(const GroundPlan& map, const WorldPlan& plan) {
  try {
    BuildSolids(map, plan, 1);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(BuildSolidsTest, ADoorInNoWallIsRefused) {
  WorldPlan plan;
  GroundPlan map = OneWallOneDoor();
  map.walls.clear();
  EXPECT_THAT(ErrorOf(map, plan), ::testing::HasSubstr("between walls"));
}

}  // namespace
}  // namespace priamos::world
