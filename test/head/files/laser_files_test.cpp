#include "head/files/laser_files.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "head/files/calibration_file.hpp"
#include "test/support/stripe_renderer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::head {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LaserFilesTest : public testing::Test {
 protected:
  LaserFilesTest() {
    for (int c = 0; c < kCameras; ++c)
      head_.lenses[c] = LensTable({0}, {0}, {{850, {386, 285}, -0.05, 0, 0.02}});
    SaveHeadModel(table_, head_);
    WritePicture("floor.png", 0.0);
    WritePicture("box.png", 0.15);
  }
  void WritePicture(const std::string& name, double height) {
    HeadSetting setting;
    setting.tilt_rad = Radians(36);
    support::StripeScene scene;
    scene.camera = *head_.CameraAt(setting, kThird);
    scene.laser = {Eigen::Vector3d(std::sin(0.35), 0, std::cos(0.35)), Eigen::Vector3d(0.46, 0, 0.60)};
    scene.board = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0, 0, height)};
    const GreyImage image = support::Render(scene, rng_);
    cv::imwrite(folder_ / name,
                cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())));
  }
  std::string Write(const std::string& text) const {
    std::ofstream(folder_ / "laser.toml") << text;
    return folder_ / "laser.toml";
  }
  std::string Table() const {
    std::ostringstream text;
    text << std::ifstream(table_).rdbuf();
    return text.str();
  }
  /// Why it was refused; the table must be what it was, byte by byte.
  std::string ReasonOf(const std::string& pictures) const {
    const std::string before = Table();
    std::string reason;
    try {
      CalibrateLaserFromFiles(pictures, table_, "");
    } catch (const ConfigError& error) {
      reason = error.what();
    }
    EXPECT_EQ(Table(), before);
    return reason;
  }

  const std::string kViews =
      "[[view]]\nimage = \"floor.png\"\ntilt_deg = 36\n"
      "[[view]]\nimage = \"box.png\"\ntilt_deg = 36\nboard_m = [0.0, 0.0, 0.15]\n";
  TemporaryFolder folder_;
  const std::string table_ = folder_ / "kastor.yaml";
  HeadModel head_;
  Rng rng_{5};
};

TEST_F(LaserFilesTest, ThePlaneGoesIntoTheTable) {
  const json dut = json::parse(CalibrateLaserFromFiles(Write(kViews), table_, "").json);
  EXPECT_LT(dut["rms_px"], 0.1);
  EXPECT_EQ(dut["views"].size(), 2u);
  EXPECT_NEAR(dut["base"]["normal"][0], std::sin(0.35), 1e-3);
  const HeadModel read = LoadHeadModel(table_);
  ASSERT_TRUE(read.laser);
  EXPECT_NEAR(read.laser->Plane().signedDistance(Eigen::Vector3d(0.46, 0, 0.60)), 0, 1e-3);
  EXPECT_EQ(read.lenses[kLeft].nodes().size(), 1u) << "the rest of the table stays";
}

TEST_F(LaserFilesTest, OutputLeavesTheTableAlone) {
  const std::string before = Table();
  CalibrateLaserFromFiles(Write(kViews), table_, folder_ / "other.yaml");
  EXPECT_EQ(Table(), before);
  EXPECT_TRUE(LoadHeadModel(folder_ / "other.yaml").laser);
}

TEST_F(LaserFilesTest, WhatCannotBeUsedIsRefusedAndTheTableStays) {
  EXPECT_THAT(ReasonOf(folder_ / "none.toml"), HasSubstr("none.toml"));
  EXPECT_THAT(ReasonOf(Write("")), HasSubstr("at least one picture"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"floor.png\"\ntilt = 3\n")), HasSubstr("laser.toml:3"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"missing.png\"\n")),
              HasSubstr("missing.png: expected an image"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"floor.png\"\ntilt_deg = 36\n")),
              HasSubstr("one straight line of space"));
  cv::imwrite(folder_ / "dark.png", cv::Mat::zeros(576, 768, CV_8UC1));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"dark.png\"\n")),
              HasSubstr("expected a line of laser light"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"floor.png\"\nnormal = [0.0, 0.0, 0.0]\n")),
              HasSubstr("a direction that is not zero"));
}

}  // namespace
}  // namespace priamos::head
