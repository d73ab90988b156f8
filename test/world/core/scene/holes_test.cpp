#include "world/core/scene/holes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace priamos::world {
namespace {

using Eigen::Vector3d;

HolePlan Pit() {
  HolePlan pit;
  pit.x_m = 2;
  pit.length_m = 1;
  pit.width_m = 2;
  pit.depth_m = 0.5;
  return pit;
}

TEST(HolesTest, ARayMeetsTheFloorBesideAndTheBottomWithin) {
  const std::vector<HolePlan> holes{Pit()};
  const auto beside = CastToFloor(holes, {0, 0, 1}, -Vector3d::UnitZ());
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->distance_m, 1, 1e-12);
  EXPECT_EQ(beside->hole, -1);
  const auto within = CastToFloor(holes, {2, 0, 1}, -Vector3d::UnitZ());
  ASSERT_TRUE(within);
  EXPECT_NEAR(within->distance_m, 1.5, 1e-12);
  EXPECT_EQ(within->hole, 0);
}

TEST(HolesTest, ASlantedRayMeetsTheFarSide) {
  const auto hit = CastToFloor({Pit()}, {0.5, 0, 1}, Vector3d(1.8, 0, -1).normalized());
  ASSERT_TRUE(hit);  // enters at x 2.3, meets the side at x 2.5 before the bottom
  EXPECT_EQ(hit->normal, -Vector3d::UnitX());
  EXPECT_NEAR(hit->distance_m, Vector3d(2, 0, -2 / 1.8).norm(), 1e-9);
}

TEST(HolesTest, FromWithinLightComesThroughTheTopAlone) {
  EXPECT_FALSE(CastToFloor({Pit()}, {2, 0, -0.4}, Vector3d::UnitZ()));
  const auto side = CastToFloor({Pit()}, {2, 0, -0.4}, Vector3d::UnitX());
  ASSERT_TRUE(side);
  EXPECT_NEAR(side->distance_m, 0.5, 1e-12);
}

RC_GTEST_PROP(HolesTest, FloorAndHolesTogetherCoverTheRoomOnce, ()) {
  std::vector<HolePlan> holes;
  const auto place = [] { return *rc::gen::inRange(-400, 400) / 100.0; };
  for (int i = *rc::gen::inRange(0, 4); i > 0; --i) {
    HolePlan hole = Pit();
    hole.x_m = place();
    hole.y_m = place();
    holes.push_back(hole);
  }
  const auto pieces = FloorAround(holes, {{-4, -4}, {4, 4}});
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d at(place() + 0.001234, place() + 0.004321);
    int covered = 0;
    for (const FloorPiece& piece : pieces)
      covered += (at.array() > piece.low.array()).all() && (at.array() < piece.high.array()).all();
    const bool inside = (at.array().abs() < 4).all();
    RC_ASSERT(covered == (inside && !HoleAt(holes, at) ? 1 : 0));
  }
}

}  // namespace
}  // namespace priamos::world
