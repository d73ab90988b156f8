#include "head/core/motion/aim.hpp"

#include <gtest/gtest.h>

#include "test/head/core/motion/aimed_head.hpp"

namespace priamos::head {
namespace {

LandmarkPrediction At(double x, double y, double sigma_m = 0.005, double sigma_rad = 0.003) {
  return {{x, y, 0},
          Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal()};
}

const HeadSetting kLooks{0, 0, {-0.02, 0.02}, {250, 250}, {1600, 1600}};

bool IsInBothPictures(const HeadModel& head, double pan, const Eigen::Vector3d& p) {
  HeadSetting setting = kLooks;
  setting.pan_rad = pan;
  for (const int camera : {kLeft, kRight}) {
    const double u = head.CameraAt(setting, camera)->Project(p).x();
    if (u < 25 || u > 743) return false;
  }
  return true;
}

TEST(Aim, LooksBetweenTheMiddleAndTheSide) {
  const double left = AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(3, 0), 1, {});
  EXPECT_NEAR(left, 0.5 * std::atan2(0.48, 2.75), 0.01);
  EXPECT_NEAR(AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(3, 0), 2, {}), -left, 0.006);
  EXPECT_NEAR(AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(3, 0), 0, {}), 0, 0.006);
}

TEST(Aim, FollowsTheLandmark) {
  EXPECT_NEAR(AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(3, 1.2), 0, {}), std::atan2(1.2, 2.75),
              0.01);
}

TEST(Aim, KeepsTheOtherSideInThePictureIfItCan) {
  // Half way to the side the other jamb might be outside.
  const double unsure = AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(3, 0, 0.15, 0.045), 1, {});
  EXPECT_LT(unsure, AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(3, 0), 1, {}) - 0.01);
}

TEST(Aim, HowADoorThatFacesTheHeadIsTurnedDoesNotMatter) {
  const HeadGeometry head;
  const LandmarkPrediction known{{head.x_m + 2, head.y_m + 2, Radians(45)}, Eigen::Matrix3d::Zero()};
  LandmarkPrediction turned = known;
  turned.covariance(2, 2) = 0.5 * 0.5;
  for (const int side : {1, 2})
    EXPECT_NEAR(AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), turned, side, {}),
                AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), known, side, {}), 0.006);
}

TEST(Aim, NearTheDoorTheSideAskedForIsInThePicture) {
  for (const double x : {1.2, 1.5, 2.0}) {
    for (const int side : {1, 2}) {
      const double pan =
          AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(x, 0.2, 0.01, 0.005), side, {});
      const double y = 0.2 + (side == 1 ? 0.48 : -0.48);
      EXPECT_TRUE(IsInBothPictures(HeadOfOneLens(), pan, {x, y, 1.2})) << "from " << x << " m, side " << side;
    }
  }
}

TEST(Aim, FromNearOnePictureShowsTheSideAlsoOfTheNextLooks) {
  HeadSetting setting = kLooks;
  setting.tilt_rad = Radians(-40);
  for (const int side : {1, 2}) {
    setting.pan_rad = AimPan(HeadOfOneLens(), setting, DoorOfFiveEdges(), At(1.1, 0), At(0.8, 0), side, {});
    for (const double x : {1.1, 0.95, 0.8})
      EXPECT_EQ(SideOutsideBy(HeadOfOneLens(), setting, DoorOfFiveEdges(), At(x, 0), side, {}), 0) << x;
  }
}

TEST(Aim, ALandmarkBehindIsNotChased) {
  AimConfig config;
  EXPECT_LE(std::abs(AimPan(HeadOfOneLens(), kLooks, DoorOfFiveEdges(), At(-3, 0.5), 1, config)),
            Radians(config.max_pan_deg));
}

TEST(Aim, StraightAheadWithoutEdges) {
  EXPECT_EQ(AimPan(HeadOfOneLens(), kLooks, LandmarkModel{}, At(3, 0), 1, {}), 0);
}

TEST(Aim, ARobotThatDrivesOnLooksFromWhereItWillBe) {
  LandmarkModel door = DoorOfFiveEdges();
  door.map_from_landmark = {3, 0, 0};
  const AimConfig config{.lead_s = 0.5};
  PoseSample robot;
  robot.twist = {0, -0.8, 0};
  const double dut = AimPan(HeadOfOneLens(), kLooks, door,
                            PredictAhead(robot, door.map_from_landmark, config.lead_s), 0, config);
  EXPECT_EQ(dut, AimPan(HeadOfOneLens(), kLooks, door, LandmarkPrediction{{3, 0.4, 0}, robot.covariance}, 0,
                        config));
  EXPECT_GT(dut, 0.1);
}

}  // namespace
}  // namespace priamos::head
