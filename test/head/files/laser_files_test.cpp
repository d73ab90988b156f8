#include "head/files/laser_files.hpp"

#include <gmock/gmock.h>

#include <algorithm>
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
  /// One line, or two: both lasers shine, the picture is the brighter of both.
  void WritePicture(const std::string& name, double height, int lasers = 1) {
    GreyImage image = OneLine(height, 0.35);
    if (lasers == 2) {
      const GreyImage far = OneLine(height, 0.232);
      for (std::size_t i = 0; i < far.pixels.size(); ++i)
        image.pixels[i] = std::max(image.pixels[i], far.pixels[i]);
    }
    cv::imwrite(folder_ / name, cv::Mat(image.height, image.width, CV_8UC1, image.pixels.data()));
  }
  GreyImage OneLine(double height, double pitch) {
    HeadSetting setting;
    setting.tilt_rad = Radians(31);
    support::StripeScene scene;
    scene.camera = *head_.CameraAt(setting, kThird);
    scene.laser = {Eigen::Vector3d(std::sin(pitch), 0, std::cos(pitch)), Eigen::Vector3d(0.46, 0, 0.60)};
    scene.board = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0, 0, height)};
    return support::Render(scene, rng_);
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
      "[[view]]\nimage = \"floor.png\"\ntilt_deg = 31\n"
      "[[view]]\nimage = \"box.png\"\ntilt_deg = 31\nboard_m = [0.0, 0.0, 0.15]\n";
  TemporaryFolder folder_;
  const std::string table_ = folder_ / "kastor.yaml";
  HeadModel head_;
  Rng rng_{5};
};

TEST_F(LaserFilesTest, ThePlaneGoesIntoTheTable) {
  const json dut = json::parse(CalibrateLaserFromFiles(Write(kViews), table_, "").json);
  ASSERT_EQ(dut["lasers"].size(), 1U);
  const json& laser = dut["lasers"][0];
  EXPECT_LT(laser["rms_px"], 0.1);
  EXPECT_EQ(laser["views"].size(), 2u);
  EXPECT_NEAR(laser["base"]["normal"][0], std::sin(0.35), 1e-3);
  const HeadModel read = LoadHeadModel(table_);
  ASSERT_EQ(read.lasers.size(), 1U);
  EXPECT_NEAR(read.lasers[0].Plane().signedDistance(Eigen::Vector3d(0.46, 0, 0.60)), 0, 1e-3);
  EXPECT_EQ(read.lenses[kLeft].nodes().size(), 1u) << "the rest of the table stays";
}

/// The nearer line is the lower one. A third picture shows that of the far laser alone.
TEST_F(LaserFilesTest, TwoLinesAreToldApartByTheirOrder) {
  WritePicture("floor.png", 0.0, 2);
  WritePicture("box.png", 0.15, 2);
  const GreyImage far = OneLine(0.08, 0.232);
  cv::imwrite(folder_ / "far.png",
              cv::Mat(far.height, far.width, CV_8UC1, const_cast<std::uint8_t*>(far.pixels.data())));
  const std::string pictures =
      Write("lasers = 2\n" + kViews +
            "[[view]]\nimage = \"far.png\"\ntilt_deg = 31\nboard_m = [0.0, 0.0, 0.08]\nline = 2\n");
  const json dut = json::parse(CalibrateLaserFromFiles(pictures, table_, "").json);
  ASSERT_EQ(dut["lasers"].size(), 2U);
  EXPECT_EQ(dut["lasers"][0]["views"].size(), 2U);
  EXPECT_EQ(dut["lasers"][1]["views"].size(), 3U);
  const HeadModel read = LoadHeadModel(table_);
  ASSERT_EQ(read.lasers.size(), 2U);
  EXPECT_NEAR(read.lasers[0].normal.x(), std::sin(0.35), 1e-3);
  EXPECT_NEAR(read.lasers[1].normal.x(), std::sin(0.232), 1e-3);
}

TEST_F(LaserFilesTest, APictureOfOneLineOfTwoNeedsItsNumber) {
  EXPECT_THAT(ReasonOf(Write("lasers = 2\n" + kViews)), HasSubstr("expected 2 lines of laser light"));
  EXPECT_THAT(ReasonOf(Write("lasers = 2\n[[view]]\nimage = \"floor.png\"\nline = 3\n")),
              HasSubstr("`line` up to 2"));
}

TEST_F(LaserFilesTest, OutputLeavesTheTableAlone) {
  const std::string before = Table();
  CalibrateLaserFromFiles(Write(kViews), table_, folder_ / "other.yaml");
  EXPECT_EQ(Table(), before);
  EXPECT_EQ(LoadHeadModel(folder_ / "other.yaml").lasers.size(), 1U);
}

TEST_F(LaserFilesTest, WhatCannotBeUsedIsRefusedAndTheTableStays) {
  EXPECT_THAT(ReasonOf(folder_ / "none.toml"), HasSubstr("none.toml"));
  EXPECT_THAT(ReasonOf(Write("")), HasSubstr("at least one picture"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"floor.png\"\ntilt = 3\n")), HasSubstr("laser.toml:3"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"missing.png\"\n")),
              HasSubstr("missing.png: expected an image"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"floor.png\"\ntilt_deg = 31\n")),
              HasSubstr("one straight line of space"));
  cv::imwrite(folder_ / "dark.png", cv::Mat::zeros(576, 768, CV_8UC1));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"dark.png\"\n")),
              HasSubstr("expected a line of laser light"));
  EXPECT_THAT(ReasonOf(Write("[[view]]\nimage = \"floor.png\"\nnormal = [0.0, 0.0, 0.0]\n")),
              HasSubstr("a direction that is not zero"));
}

}  // namespace
}  // namespace priamos::head
