// A look of a simulated run at a door that is narrower than its model, with the shadow of its frame beside
// one jamb.

#include <gtest/gtest.h>

#include <string>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "head/files/calibration_file.hpp"
#include "head/files/image_file.hpp"
#include "head/vision_options.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const std::string kPictures = PRIAMOS_SOURCE_DIR "/test/head/narrow_door/";
const std::string kDeployment = PRIAMOS_SOURCE_DIR "/config/sim/";

HeadSetting Setting() {
  HeadSetting setting{0.0361, -0.0873, {-0.0201, 0.0201}};
  setting.zoom_step = {250, 250};
  setting.focus_step = {1600, 1600};
  return setting;
}

/// By odometry alone.
PoseSample Believed() {
  PoseSample robot;
  robot.map_from_base = {-3.1154, 0.0015, 0.0015};
  const double rho_y_yaw = 0.38, x = 0.173, y = 0.188, yaw = 0.081;
  robot.covariance << x * x, 0, 0, 0, y * y, rho_y_yaw * y * yaw, 0, rho_y_yaw * y * yaw, yaw * yaw;
  return robot;
}

GreyImage Picture(const std::string& name) {
  std::string notes;
  return ReadImage(kPictures + name, notes);
}

/// Its best solution left one side out, and was refused for that; another one of the same place has both.
TEST(NarrowDoor, IsFoundByTheSolutionThatHasBothOfItsSides) {
  const HeadModel head = LoadHeadModel(kDeployment + "kastor.yaml");
  const LookOptions options = EvaluatorOptions(LoadConfig<HeadConfig>(kDeployment + "head.toml"), head);
  const LandmarkModel model = test::DoorModel();
  LookInput look{
      &model, Believed(), {Picture("left.jpg"), Picture("right.jpg")}, Setting(), Picture("third.jpg")};
  const LookResult dut = LookEvaluator(head, options).Evaluate(look);
  ASSERT_EQ(dut.fix.verdict, Verdict::kFound) << Describe(dut.fix.verdict);
  // Where all later looks of this run had it.
  EXPECT_NEAR(dut.fix.base_from_landmark.x, 3.120, 0.01);
  EXPECT_NEAR(dut.fix.base_from_landmark.y, 0.068, 0.01);
}

}  // namespace
}  // namespace priamos::head
