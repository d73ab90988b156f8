#include "head/core/camera/head_setting.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

const HeadSetting kSomewhere{.pan_rad = 0.3,
                             .tilt_rad = -0.1,
                             .vergence_rad = {0.02, -0.02},
                             .zoom_step = {650, 660},
                             .focus_step = {900, 910}};

TEST(HeadSettingTest, IsTheSameAsItself) {
  EXPECT_TRUE(IsSameSetting(kSomewhere, kSomewhere));
  EXPECT_TRUE(IsSameSetting(kSomewhere, kSomewhere, 0));
}

TEST(HeadSettingTest, EveryAngleCountsWithTheTolerance) {
  for (const double sign : {-1.0, 1.0}) {
    for (int axis = 0; axis < 4; ++axis) {
      HeadSetting other = kSomewhere;
      double* const angles[] = {&other.pan_rad, &other.tilt_rad, &other.vergence_rad[0],
                                &other.vergence_rad[1]};
      *angles[axis] += sign * 0.0009;
      EXPECT_TRUE(IsSameSetting(kSomewhere, other, 0.001)) << axis;
      EXPECT_FALSE(IsSameSetting(kSomewhere, other)) << axis << ": the usual tolerance is smaller";
      *angles[axis] += sign * 0.0002;
      EXPECT_FALSE(IsSameSetting(kSomewhere, other, 0.001)) << axis;
      EXPECT_FALSE(IsSameSetting(other, kSomewhere, 0.001)) << axis;
    }
  }
}

TEST(HeadSettingTest, ZoomAndFocusMayBeOneStepOff) {
  for (const int sign : {-1, 1}) {
    for (int motor = 0; motor < 4; ++motor) {
      HeadSetting other = kSomewhere;
      int* const steps[] = {&other.zoom_step[0], &other.zoom_step[1], &other.focus_step[0],
                            &other.focus_step[1]};
      *steps[motor] += sign;
      EXPECT_TRUE(IsSameSetting(kSomewhere, other)) << motor;
      *steps[motor] += sign;
      EXPECT_FALSE(IsSameSetting(kSomewhere, other)) << motor;
      EXPECT_FALSE(IsSameSetting(kSomewhere, other, 1))
          << motor << ": angles have a tolerance, steps have none";
    }
  }
}

}  // namespace
}  // namespace priamos::head
