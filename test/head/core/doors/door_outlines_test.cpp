#include "head/core/doors/door_outlines.hpp"

#include <gtest/gtest.h>

#include "head/core/stand/camera_stand.hpp"
#include "test/head/exact_view.hpp"

namespace priamos::head {
namespace {

constexpr double kCamera_m = 1.2;

/// A door 4 m ahead, drawn line by line as a level camera sees it; origin at the camera.
class DoorOutlinesTest : public testing::Test {
 protected:
  static CameraModel Level() {
    CameraModel camera;
    camera.image_from_base << 500, 0, 384, 0, 0, 500, 288, 0, 0, 0, 1, 0;
    return OnTheFloor(camera, {});
  }
  void Upright(double y, double top, double bottom) {
    scene_.See({4, y, top - kCamera_m}, {4, y, bottom - kCamera_m});
  }
  void Lintel(double left, double right, double height = 2.0) {
    scene_.See({4, left, height - kCamera_m}, {4, right, height - kCamera_m});
  }
  std::vector<DoorOutline> Find() {
    view_ = scene_.View();
    return FindOutlines(view_, {});
  }

  test::ExactView scene_{Level()};
  CameraView view_;
};

TEST_F(DoorOutlinesTest, TwoUprightsAndALintelAreOneOutlineWithoutAScale) {
  Upright(0.45, 2.0, 0);
  Upright(-0.45, 2.0, 0);
  Lintel(0.45, -0.45);
  const auto dut = Find();
  ASSERT_EQ(dut.size(), 1u);
  constexpr double kAbove_m = 2.0 - kCamera_m;
  EXPECT_NEAR(kAbove_m * dut[0].width(), 0.9, 1e-3);
  EXPECT_LT((kAbove_m * dut[0].At(0) - Eigen::Vector2d(4, 0.45)).norm(), 0.01) << "left";
  for (int side = 0; side < 2; ++side) {
    EXPECT_TRUE(dut[0].foot_inside[side]);
    EXPECT_NEAR(dut[0].falls[side] / dut[0].rises[side], kCamera_m / kAbove_m, 0.02);
    EXPECT_NEAR(dut[0].covered[side], 1, 0.02);
  }
}

TEST_F(DoorOutlinesTest, WithoutALintelAboveTheCameraThereIsNone) {
  Upright(0.45, 2.0, 0);
  Upright(-0.45, 2.0, 0);
  EXPECT_TRUE(Find().empty());
  Lintel(0.45, -0.45, 0.9);
  EXPECT_TRUE(Find().empty()) << "a table";
}

TEST_F(DoorOutlinesTest, AnUprightThatLeansIsNone) {
  Upright(0.45, 2.0, 0);
  scene_.See({4, -0.45, 2.0 - kCamera_m}, {4, -0.55, -kCamera_m});
  Lintel(0.45, -0.45);
  EXPECT_TRUE(Find().empty());
}

}  // namespace
}  // namespace priamos::head
