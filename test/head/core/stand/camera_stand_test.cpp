#include "head/core/stand/camera_stand.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/geometry.hpp"
#include "test/head/exact_view.hpp"

namespace priamos::head {
namespace {

CameraModel OwnFrame() {
  CameraModel camera;
  camera.image_from_base << 500, 0, 320, 0, 0, 500, 240, 0, 0, 0, 1, 0;
  return camera;
}

Eigen::Vector3d UpOf(const CameraStand& stand) {
  return BaseFromCamera(stand).linear().transpose() * Eigen::Vector3d::UnitZ();
}

RC_GTEST_PROP(StandOf, TiltAndRollComeBackFromTheDirectionUp, ()) {
  const CameraStand stand{1, *rc::gen::inRange(-1000, 1000) * 1e-3, *rc::gen::inRange(-1500, 1500) * 1e-3};
  const CameraStand dut = StandOf(UpOf(stand), stand.height_m);
  RC_ASSERT(std::abs(dut.tilt_rad - stand.tilt_rad) < 1e-9);
  RC_ASSERT(std::abs(dut.roll_rad - stand.roll_rad) < 1e-9);
}

TEST(TiltAndRollCovariance, IsThatOfSmallTurns) {
  const CameraStand stand{1, 0.2, -0.1};
  VerticalDirection vertical;
  vertical.up = UpOf(stand);
  // Turns by (tilt, roll) with these variances, as they move the direction up.
  const Eigen::Vector3d by_tilt = (UpOf({1, 0.2 + 1e-6, -0.1}) - vertical.up) / 1e-6,
                        by_roll = (UpOf({1, 0.2, -0.1 + 1e-6}) - vertical.up) / 1e-6;
  vertical.covariance = 4e-6 * by_tilt * by_tilt.transpose() + 9e-6 * by_roll * by_roll.transpose();
  const Eigen::Matrix2d dut = TiltAndRollCovariance(vertical);
  EXPECT_NEAR(dut(0, 0), 4e-6, 1e-10);
  EXPECT_NEAR(dut(1, 1), 9e-6, 1e-10);
  EXPECT_NEAR(dut(0, 1), 0, 1e-10);
}

TEST(OnTheFloor, ACameraThatLooksDownSeesTheFloorInItsMiddle) {
  const CameraModel dut = OnTheFloor(OwnFrame(), {1.2, Radians(45), 0});
  EXPECT_LT((dut.Project({1.2, 0, 0}) - Eigen::Vector2d(320, 240)).norm(), 1e-9);
}

TEST(SeenFrom, LinesGetThePlanesOfTheOtherFrame) {
  test::ExactView picture(OwnFrame());
  picture.Draw({320, 100}, {320, 300});
  const CameraModel floor = OnTheFloor(OwnFrame(), {1.2, 0, 0});
  const CameraView dut = SeenFrom(picture.View(), floor);
  EXPECT_EQ(dut.camera, &floor);
  EXPECT_NEAR(dut.lines[0].plane.dot(Eigen::Vector4d(3, 0, 0.4, 1)), 0, 1e-9) << "straight ahead";
}

}  // namespace
}  // namespace priamos::head
