#include "console/plan_json.hpp"

#include <gtest/gtest.h>

namespace priamos::console {
namespace {

TEST(PlanJson, HasCornersOfWallsAndPlacesOfDoors) {
  GroundPlan plan;
  WallPlan wall;
  wall.from_m = {0, 0};
  wall.to_m = {4, 0};
  wall.thickness_m = 0.2;
  plan.walls.push_back(wall);
  DoorPlan door;
  door.id = 7;
  door.name = "B\"üro";
  door.x_m = 2;
  door.yaw_deg = 90;
  plan.doors.push_back(door);
  const auto json = ToJson(plan);
  ASSERT_EQ(json["walls"].size(), 1u);
  double width = 0, height = 0;
  for (const auto& corner : json["walls"][0]) {
    width = std::max(width, corner[0].get<double>());
    height = std::max(height, corner[1].get<double>());
  }
  EXPECT_GE(width, 4);
  EXPECT_NEAR(height, 0.1, 1e-9);
  EXPECT_EQ(json["doors"][0]["id"], 7);
  EXPECT_NEAR(json["doors"][0]["yaw_rad"].get<double>(), 1.5707963, 1e-6);
  EXPECT_EQ(json["doors"][0]["name"], "B\"üro");
}

TEST(PlanJson, ACupboardStandsBehindItsFront) {
  GroundPlan plan;
  CupboardPlan cupboard;
  cupboard.x_m = 1;
  cupboard.depth_m = 0.4;
  cupboard.width_m = 1;
  plan.cupboards.push_back(cupboard);
  for (const auto& corner : ToJson(plan)["cupboards"][0]["corners"]) {
    const double x = corner[0], y = corner[1];
    EXPECT_TRUE(std::abs(x - 1) < 1e-9 || std::abs(x - 1.4) < 1e-9) << x;
    EXPECT_NEAR(std::abs(y), 0.5, 1e-9);
  }
}

TEST(PlanJson, ANoGoAreaHasANameAndCorners) {
  GroundPlan plan;
  plan.no_go.push_back({"stairs", 3, 2, 0, 2, 1});
  const auto area = ToJson(plan)["no_go"][0];
  EXPECT_EQ(area["name"], "stairs");
  EXPECT_EQ(area["corners"].size(), 4u);
}

}  // namespace
}  // namespace priamos::console
