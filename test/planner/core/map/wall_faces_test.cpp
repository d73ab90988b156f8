#include "planner/core/map/wall_faces.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "test/planner/core/plans.hpp"

namespace priamos::planner {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

WallPlan Wall(double x1, double y1, double x2, double y2) {
  WallPlan wall;
  wall.from_m = {x1, y1};
  wall.to_m = {x2, y2};
  wall.thickness_m = 0.2;
  return wall;
}

/// A corridor along x between y = -1 and 1, with a doorway in its north wall, and a room behind that.
GroundPlan Corridor() {
  GroundPlan plan;
  plan.walls = {Wall(0, -1.1, 20, -1.1), Wall(0, 1.1, 8, 1.1), Wall(8.9, 1.1, 20, 1.1),
                Wall(20.1, -1, 20.1, 1), Wall(0, 3.1, 20, 3.1)};
  return plan;
}

TEST(WallFaces, AWallHasTwoAndADoorwayPartsNone) {
  GroundPlan plan;
  plan.walls = {Wall(0, 0, 4, 0), Wall(5, 0, 9, 0)};
  const auto dut = FacesOf(plan);
  ASSERT_THAT(dut, SizeIs(2));
  for (const WallFace& face : dut) EXPECT_NEAR(face.length_m(), 9, 1e-9);
  EXPECT_NEAR(dut[0].from.y(), 0.1, 1e-9);
  EXPECT_NEAR(dut[0].along().x(), 1, 1e-9) << "who is north of it has it to the right on the way east";
  plan.walls[1] = Wall(6.5, 0, 9, 0);
  EXPECT_THAT(FacesOf(plan), SizeIs(4)) << "a gap as wide as a corridor";
  plan.walls[1] = Wall(5, 0.05, 9, 0.05);
  EXPECT_THAT(FacesOf(plan), SizeIs(4)) << "not on one line";
}

TEST(WallFaces, ACorridorHasTheNearestOneOnEitherSide) {
  const auto dut = FacesAlong(FacesOf(Corridor()), {{1, 0}, {15, 0}});
  ASSERT_THAT(dut, SizeIs(2)) << "not those of the room behind the wall";
  for (const WallFace& face : dut) {
    EXPECT_NEAR(std::abs(face.from.y()), 1, 1e-9);
    EXPECT_NEAR(face.length_m(), 20, 1e-9);
    const Eigen::Vector2d right(face.along().y(), -face.along().x());
    EXPECT_GT(right.dot(face.from - Eigen::Vector2d(5, 0)), 0) << "the wall is to the right";
  }
}

TEST(WallFaces, AWayWithoutWallsHasNone) {
  EXPECT_THAT(FacesAlong(FacesOf(Corridor()), {{1, 30}, {15, 30}}), IsEmpty());
  EXPECT_THAT(FacesAlong({}, {{1, 0}, {15, 0}}), IsEmpty());
  EXPECT_THAT(FacesAlong(FacesOf(Corridor()), {}), IsEmpty());
}

TEST(WallFaces, NoMoreThanTheRobotTakes) {
  GroundPlan plan;
  for (int i = 0; i < 20; ++i) plan.walls.push_back(Wall(4 * i, -1, 4 * i + 1.5, -1));
  EXPECT_THAT(FacesAlong(FacesOf(plan), {{0, 0}, {80, 0}}), SizeIs(kMostFaces));
}

TEST(WallFaces, TheEndOfACorridorIsAhead) {
  const auto faces = FacesOf(Corridor());
  EXPECT_NEAR(DistanceAhead(faces, {2, 0}, {1, 0}).value(), 18, 1e-9);
  EXPECT_FALSE(DistanceAhead(faces, {2, 0}, {-1, 0})) << "open on that side";
}

}  // namespace
}  // namespace priamos::planner
