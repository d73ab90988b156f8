#include "head/core/doors/outline_gauge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

class OutlineGaugeTest : public testing::Test {
 protected:
  OutlineGaugeTest() {
    camera_.image_from_base << 800, 0, 384, 0, 0, 800, 288, 0, 0, 0, 1, 0;
    const CameraModel level = OnTheFloor(camera_, {0, stand_.tilt_rad, stand_.roll_rad});
    for (int side = 0; side < 2; ++side) {
      const Eigen::Vector2d at = door_ * Eigen::Vector2d(0, side == 0 ? 0.45 : -0.45);
      outline_.corners[side] = level.Project({at.x(), at.y(), kAbove_m});
    }
  }

  static constexpr double kAbove_m = 0.85;
  CameraModel camera_;
  const CameraStand stand_{1.2, 0.1, -0.03};
  const Pose2 door_{4, 0.5, 0.6};
  DoorOutline outline_;
};

TEST_F(OutlineGaugeTest, CornersTellDirectionAndShapeOfTheirPlane) {
  const OutlineGauge dut = GaugeOutline(outline_, camera_, stand_, Eigen::Matrix2d::Zero(), 0);
  EXPECT_NEAR(dut.yaw_rad, door_.yaw, 1e-9);
  EXPECT_NEAR(kAbove_m * dut.width, 0.9, 1e-9);
  EXPECT_NEAR(kAbove_m * dut.range, door_.translation().norm(), 1e-9);
  EXPECT_EQ(dut.yaw_sigma_rad, 0);
}

TEST_F(OutlineGaugeTest, ErrorsOfCornersAndStandAddUp) {
  const Eigen::Matrix2d stand = Eigen::Matrix2d::Identity() * 1e-6;
  const OutlineGauge corners = GaugeOutline(outline_, camera_, stand_, Eigen::Matrix2d::Zero(), 0.5),
                     tilt = GaugeOutline(outline_, camera_, stand_, stand, 0),
                     both = GaugeOutline(outline_, camera_, stand_, stand, 0.5);
  EXPECT_NEAR(both.yaw_sigma_rad, std::hypot(corners.yaw_sigma_rad, tilt.yaw_sigma_rad), 1e-9);
  EXPECT_GT(corners.range_sigma, 0);
  EXPECT_GT(tilt.width_sigma, 0);
}

}  // namespace
}  // namespace priamos::head
