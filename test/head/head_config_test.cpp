#include "head/head_config.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "common/geometry.hpp"
#include "head/vision_options.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

std::string ReasonOf(std::string_view text) {
  return support::ThrownReason([&] { ParseConfig<HeadConfig>("head.toml", text); });
}

TEST(HeadConfigTest, ShippedFilesLoad) {
  for (const char* file : {"/config/sim/head.toml", "/config/robot/head.toml"}) {
    const auto dut = LoadConfig<HeadConfig>(std::string(PRIAMOS_SOURCE_DIR) + file);
    EXPECT_EQ(dut.mode, "look") << file;
    EXPECT_EQ(dut.calibration, "kastor.yaml") << file;
  }
}

TEST(HeadConfigTest, PrintedConfigurationLoadsAgain) {
  HeadConfig config;
  config.tilt_deg = -7.5;
  config.vision.min_log_odds = 9.5;
  config.reference.yaw_deg = 170;
  config.plan.zoom.nodes = 3;
  config.laser.rate_hz = 4;
  config.drawing.cameras[kLeft].yaw_rad = 0.01;
  std::ostringstream text;
  PrintConfig(text, config);
  const auto dut = ParseConfig<HeadConfig>("printed", text.str());
  EXPECT_EQ(dut.tilt_deg, -7.5);
  EXPECT_EQ(dut.vision.min_log_odds, 9.5);
  EXPECT_EQ(dut.reference.yaw_deg, 170);
  EXPECT_EQ(dut.plan.zoom.nodes, 3);
  EXPECT_EQ(dut.laser.rate_hz, 4);
  EXPECT_EQ(dut.drawing.cameras[kLeft].yaw_rad, 0.01);
}

TEST(HeadConfigTest, MistakesAreNamedWithTheirLine) {
  EXPECT_THAT(ReasonOf("rate_hz = 1\n"), HasSubstr("head.toml:1:rate_hz"));
  EXPECT_THAT(ReasonOf("\nmode = \"sleep\"\n"), HasSubstr("head.toml:2:mode"));
  EXPECT_THAT(ReasonOf("[vision]\nmin_contrast = 0\n"), HasSubstr("head.toml:2:vision.min_contrast"));
  EXPECT_THAT(ReasonOf("[reference]\nerror_m = -1\n"), HasSubstr("head.toml:2:reference.error_m"));
  EXPECT_THAT(ReasonOf("colour = 3\n"), HasSubstr("head.toml:1:colour"));
}

TEST(HeadConfigTest, NearerToTheEndStopAMotorCannotComeFromBelow) {
  const std::string motors = "[motors]\napproach_steps = 30\n";
  EXPECT_EQ(ReasonOf("zoom_step = 30\nfocus_step = 30\n" + motors), "");
  EXPECT_THAT(ReasonOf("zoom_step = 29\n" + motors), HasSubstr("zoom not below motors.approach_steps"));
  EXPECT_THAT(ReasonOf("focus_step = 29\n" + motors), HasSubstr("focus not below motors.approach_steps"));
  EXPECT_THAT(ReasonOf("[plan.zoom]\nfirst = 29\n" + motors), HasSubstr("zoom not below"));
  EXPECT_THAT(ReasonOf("[plan.focus]\nfirst = 29\n" + motors), HasSubstr("focus not below"));
}

TEST(HeadConfigTest, CamerasOfALookConvergeSymmetrically) {
  HeadConfig config;
  config.tilt_deg = -5;
  config.convergence_deg = 2;
  config.zoom_step = 300;
  config.focus_step = 1200;
  const HeadSetting dut = config.LookSetting();
  EXPECT_EQ(dut.pan_rad, 0);
  EXPECT_NEAR(dut.tilt_rad, Radians(-5), 1e-12);
  // Positive is to the left: towards the middle the left camera turns right.
  EXPECT_NEAR(dut.vergence_rad[kLeft], Radians(-2), 1e-12);
  EXPECT_NEAR(dut.vergence_rad[kRight], Radians(2), 1e-12);
  EXPECT_THAT(dut.zoom_step, testing::Each(300));
  EXPECT_THAT(dut.focus_step, testing::Each(1200));
}

TEST(HeadConfigTest, WatchingDiffersFromALookByItsTiltAlone) {
  HeadConfig config;
  config.laser.tilt_deg = 33;
  HeadSetting expected = config.LookSetting();
  expected.tilt_rad = Radians(33);
  EXPECT_TRUE(IsSameSetting(config.WatchSetting(), expected, 1e-12));
  EXPECT_FALSE(IsSameSetting(config.WatchSetting(), config.LookSetting()));
}

TEST(VisionOptions, WhatTheConfigurationSaysReachesTheFinder) {
  VisionConfig vision;
  vision.model_sigma_m = 0.003;
  vision.camera_sigma_px = 0.2;
  vision.min_log_odds = 11;
  vision.min_lead = 4;
  HeadModel head;
  head.base_covariance.diagonal().setConstant(0.25);
  const LandmarkFixOptions dut = FinderOptions(vision, head);
  EXPECT_EQ(dut.solver.model_sigma_m, 0.003);
  EXPECT_EQ(dut.solver.camera_sigma_px, 0.2);
  EXPECT_EQ(dut.stereo.camera_sigma_px, 0.2);
  EXPECT_EQ(dut.solver.base_covariance, head.base_covariance);
  EXPECT_EQ(dut.min_log_odds, 11);
  EXPECT_EQ(dut.min_lead, 4);
}

TEST(VisionOptions, WhatTheConfigurationSaysReachesTheEdgeOperator) {
  VisionConfig vision;
  vision.min_contrast = 17;
  vision.min_edge_px = 23;
  const EdgeOperator::Options dut = EdgeOptions(vision);
  EXPECT_EQ(dut.min_contrast, 17);
  EXPECT_EQ(dut.min_length_px, 23);
}

TEST(VisionOptions, AWholeLookHasEdgesFinderAndDrift) {
  HeadConfig config;
  config.vision.min_contrast = 17;
  config.vision.min_log_odds = 11;
  config.vision.model_sigma_m = 0.004;
  config.drift.calibration_sigma_px = 0.3;
  const LookOptions dut = EvaluatorOptions(config, {});
  EXPECT_EQ(dut.edges.min_contrast, 17);
  EXPECT_EQ(dut.finder.min_log_odds, 11);
  EXPECT_EQ(dut.drift.model_sigma_m, 0.004);
  EXPECT_EQ(dut.drift.calibration_sigma_px, 0.3);
}

}  // namespace
}  // namespace priamos::head
