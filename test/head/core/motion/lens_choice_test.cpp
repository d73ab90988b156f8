#include "head/core/motion/lens_choice.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "test/head/core/motion/aimed_head.hpp"

namespace priamos::head {
namespace {

constexpr int kApproach_steps = 25;

/// 815 to 1500 px.
HeadModel Head() {
  const std::vector<int> zooms{50, 650, 1250, 1850}, focuses{1000, 2000};
  std::vector<LensState> nodes;
  for (const int zoom : zooms)
    for (std::size_t i = 0; i < focuses.size(); ++i)
      nodes.push_back({815 * std::pow(1500.0 / 815, (zoom - 50) / 1800.0), {383.5, 287.5}, 0, 0, 0.02});
  HeadModel head;
  for (LensTable& lens : head.lenses) lens = LensTable(zooms, focuses, nodes);
  return head;
}

LandmarkModel Door() {
  LandmarkModel model = DoorOfFiveEdges();
  model.edges.push_back({{0.1, 0.4, 1}, {0.9, 0.4, 1}, -kPi, kPi, 3});
  return model;
}

/// A base so far before the door, which faces it.
PoseSample Before(double distance_m, double sigma_m = 0.005, double sigma_rad = 0.002) {
  PoseSample robot;
  robot.map_from_base = {-distance_m, 0, 0};
  robot.covariance =
      Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
  return robot;
}

const HeadSetting kFixed{0, -0.087, {-0.02, 0.02}, {250, 250}, {1600, 1600}};

HeadSetting Chosen(const PoseSample& robot, const HeadSetting& here = kFixed, int side = 1,
                   const LensChoiceConfig& config = {}) {
  return ChooseLens(Head(), kFixed, here, {Door(), robot, side}, {}, config, kApproach_steps);
}

KeptEdges KeptOf(const HeadSetting& setting, const PoseSample& robot, double lead_s) {
  PoseSample then = robot;
  then.map_from_base = Integrate(robot.map_from_base, robot.twist, lead_s);
  return KeptAt(Head(), setting, Door(), Predict(then, {}), {});
}

PoseSample Driving(PoseSample robot) {
  robot.twist = {0.3, 0, 0};
  return robot;
}

TEST(LensChoice, FarAwayAndStandingTheLandmarkIsAsLargeAsFits) {
  const HeadSetting far = Chosen(Before(5.5)), near = Chosen(Before(3));
  EXPECT_GT(far.zoom_step[0], near.zoom_step[0]);
  EXPECT_GT(near.zoom_step[0], kFixed.zoom_step[0]);
  EXPECT_EQ(far.zoom_step[0], far.zoom_step[1]);
  for (const auto& [distance, setting] : {std::pair{5.5, far}, {3.0, near}})
    EXPECT_EQ(KeptOf(setting, Before(distance), 0).count(), 5) << "all but the leaf";
}

TEST(LensChoice, AllElseIsThatOfTheFixedSetting) {
  const HeadSetting dut = Chosen(Before(5));
  EXPECT_EQ(dut.tilt_rad, kFixed.tilt_rad);
  EXPECT_EQ(dut.vergence_rad, kFixed.vergence_rad);
  EXPECT_GT(dut.pan_rad, 0) << "towards the side that was ordered";
}

TEST(LensChoice, ALandmarkThatMayBeElsewhereIsNotLookedForThroughALongLens) {
  EXPECT_LE(Chosen(Before(4, 0.3, 0.14)).zoom_step[0], kFixed.zoom_step[0]);
}

TEST(LensChoice, APartOfALandmarkIsNotEnlarged) {
  const HeadSetting dut = Chosen(Before(1.4));
  EXPECT_FALSE(KeptOf(dut, Before(1.4), 0).whole);
  EXPECT_LE(dut.zoom_step[0], kFixed.zoom_step[0]);
}

TEST(LensChoice, FocusesOnTheLandmark) {
  const LensFocus optics;
  const HeadSetting dut = Chosen(Before(2.25));
  EXPECT_NEAR(optics.DioptreAt(dut.focus_step[0]), 1 / 2.05, 0.03);
  EXPECT_EQ(Chosen(Before(1.2)).focus_step[0], 1000) << "as near as was calibrated";
}

TEST(LensChoice, ADrivingBaseDoesNotWaitForASmallGain) {
  const PoseSample robot = Driving(Before(4));
  const HeadSetting dut = Chosen(robot), standing = Chosen(Before(4));
  EXPECT_LT(LensTravel(250, dut.zoom_step[0], kApproach_steps, {}), 0.5);
  EXPECT_GT(standing.zoom_step[0], dut.zoom_step[0]);
}

TEST(LensChoice, StaysWhereItIsForLittle) {
  HeadSetting here = Chosen(Before(4));
  const HeadSetting dut = Chosen(Before(4.05), here);
  EXPECT_EQ(dut.zoom_step, here.zoom_step);
  EXPECT_EQ(dut.focus_step, here.focus_step);
}

TEST(LensChoice, LooksFromWhereTheBaseWillBeByThen) {
  // By the time a long lens is there the door would no longer fit.
  const HeadSetting slow = Chosen(Before(3.2)), fast = Chosen([] {
                                                  PoseSample robot = Before(3.2);
                                                  robot.twist = {0.9, 0, 0};
                                                  return robot;
                                                }());
  EXPECT_LT(fast.zoom_step[0], slow.zoom_step[0]);
}

TEST(LensChoice, OneCalibratedSettingIsKept) {
  HeadModel head;
  for (LensTable& lens : head.lenses)
    lens = LensTable({250}, {1600}, {LensState{890, {383.5, 287.5}, 0, 0, 0.02}});
  const HeadSetting here{0, 0, {}, {650, 650}, {1000, 1000}};
  const HeadSetting dut = ChooseLens(head, kFixed, here, {Door(), Before(5), 0}, {}, {}, kApproach_steps);
  EXPECT_EQ(dut.zoom_step, kFixed.zoom_step);
  EXPECT_EQ(dut.focus_step, kFixed.focus_step);
}

TEST(LensChoice, AMotorComesFromBelow) {
  const LensChoiceConfig config;
  EXPECT_NEAR(LensTravel(500, 500, 25, config), 2 * 2 * std::sqrt(25 / 4000.0), 1e-9);
  EXPECT_LT(LensTravel(400, 600, 25, config), LensTravel(600, 400, 25, config));
  EXPECT_NEAR(LensTravel(0, 1625, 25, config) - LensTravel(0, 825, 25, config), 1, 1e-9) << "at full speed";
}

RC_GTEST_PROP(LensChoice, NeverLosesWhatTheFixedSettingKeepsAndStaysInTheTable, ()) {
  const auto in = [](double least, double most) {
    return least + (most - least) * *rc::gen::inRange(0, 1001) / 1000.0;
  };
  const double sigma = in(0, 1);
  PoseSample robot = Before(in(0.8, 7), 0.3 * sigma * sigma, 0.14 * sigma * sigma);
  robot.map_from_base.y = in(-0.8, 0.8);
  robot.map_from_base.yaw = in(-0.4, 0.4);
  robot.twist = {in(-0.1, 0.4), in(-0.05, 0.05), in(-0.1, 0.1)};
  HeadSetting here = kFixed;
  here.zoom_step.fill(*rc::gen::inRange(0, 2001));
  here.focus_step.fill(*rc::gen::inRange(0, 2001));
  const int side = *rc::gen::inRange(0, 3);
  const LensChoiceConfig config;
  const AimConfig aim;
  const HeadSetting dut = Chosen(robot, here, side, config);
  RC_ASSERT(Head().CameraAt(dut, kLeft) && Head().CameraAt(dut, kRight));
  RC_ASSERT(dut.zoom_step[0] >= 50 && dut.zoom_step[0] <= 1850);
  RC_ASSERT(dut.focus_step[0] >= 1000 && dut.focus_step[0] <= 2000);

  double travel_s = 0;
  for (int i = 0; i < 2; ++i) {
    travel_s = std::max({travel_s, LensTravel(here.zoom_step[i], dut.zoom_step[i], kApproach_steps, config),
                         LensTravel(here.focus_step[i], dut.focus_step[i], kApproach_steps, config)});
  }
  const double extra_s = std::max(0.0, travel_s - config.turn_s);
  PoseSample then = robot;
  then.map_from_base = Integrate(robot.map_from_base, robot.twist, aim.lead_s);
  HeadSetting fixed = kFixed;
  fixed.pan_rad = AimPan(Head(), kFixed, Door(), Predict(then, {}), side, aim);
  const KeptEdges wanted = KeptOf(fixed, robot, aim.lead_s);
  const int lost = KeptOf(dut, robot, aim.lead_s + extra_s).Lost(wanted);
  // While the motors bring it there from elsewhere the fixed setting itself may lose some.
  LensChoiceConfig away = config;
  if (lost > 0) {
    HeadSetting back = kFixed;
    const double back_s = std::max(LensTravel(here.zoom_step[0], 250, kApproach_steps, away),
                                   LensTravel(here.focus_step[0], 1600, kApproach_steps, away));
    const double lead_s = aim.lead_s + std::max(0.0, back_s - config.turn_s);
    then.map_from_base = Integrate(robot.map_from_base, robot.twist, lead_s);
    back.pan_rad = AimPan(Head(), kFixed, Door(), Predict(then, {}), side, aim);
    RC_ASSERT(lost <= KeptOf(back, robot, lead_s).Lost(wanted));
  }
}

}  // namespace
}  // namespace priamos::head
