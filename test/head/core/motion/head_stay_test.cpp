#include "head/core/motion/head_stay.hpp"

#include <gtest/gtest.h>

#include "test/head/core/motion/aimed_head.hpp"

namespace priamos::head {
namespace {

HeadSetting Setting(double pan_deg, double tilt_deg) {
  return {Radians(pan_deg), Radians(tilt_deg), {-0.02, 0.02}, {250, 250}, {1600, 1600}};
}

LandmarkPrediction At(double x_m) {
  return {{x_m, 0, 0}, Eigen::Vector3d(2.5e-5, 2.5e-5, 9e-6).asDiagonal()};
}

bool Stays(const HeadSetting& here, const HeadSetting& best, double x_m) {
  return MayStay(HeadOfOneLens(), {here, best}, DoorOfFiveEdges(), At(x_m), 1, {}, {});
}

TEST(MayStay, WhereItSeesAsMuch) {
  EXPECT_TRUE(Stays(Setting(20, -38), Setting(22, -40), 1));
  EXPECT_TRUE(Stays(Setting(20, -38), Setting(20, -38), 1));
}

TEST(MayStay, NotWhereTheLintelOrTheSideWouldBeMissed) {
  EXPECT_FALSE(Stays(Setting(20, -5), Setting(20, -38), 1));
  EXPECT_FALSE(Stays(Setting(-30, -38), Setting(20, -38), 1));
}

TEST(MayStay, TiltedUpWhenTheLintelIsAboutToLeaveThePictures) {
  EXPECT_TRUE(Stays(Setting(20, -45), Setting(40, -5), 0.6));
}

}  // namespace
}  // namespace priamos::head
