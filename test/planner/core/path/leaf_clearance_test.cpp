#include "planner/core/path/leaf_clearance.hpp"

#include <gtest/gtest.h>

namespace priamos::planner {
namespace {

TEST(FreeWidth, ItGrowsWithTheAngleUpToTheWholeOpening) {
  const DoorPlan door;
  double before_m = -1;
  for (const double deg : {0.0, 30.0, 50.0, 70.0, 80.0, 85.0, 90.0}) {
    const double left_m = FreeWidth(door, "left", Radians(deg));
    EXPECT_NEAR(left_m, FreeWidth(door, "right", Radians(deg)), 1e-9);
    EXPECT_GE(left_m, before_m) << deg;
    before_m = left_m;
  }
  EXPECT_EQ(FreeWidth(door, "left", 0), 0);
  EXPECT_EQ(FreeWidth(door, "left", Radians(100)), door.opening_width_m);
  EXPECT_NEAR(FreeWidth(door, "left", Radians(90)), door.opening_width_m, 1e-9) << "swing-clear hinges";
  EXPECT_LT(FreeWidth(door, "left", Radians(80)), 0.80);
  EXPECT_GT(FreeWidth(door, "left", Radians(86)), 0.80);
}

}  // namespace
}  // namespace priamos::planner
