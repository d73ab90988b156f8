#include "head/files/offline_calibration.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "common/config.hpp"
#include "test/support/calibration_scene.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::head {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class OfflineCalibrationTest : public testing::Test {
 protected:
  OfflineCalibrationTest() { std::filesystem::create_directories(folder_); }
  ~OfflineCalibrationTest() override { std::filesystem::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  CameraModel Camera(double azimuth) const {
    support::CameraView view;
    view.azimuth_rad = azimuth;
    return support::MakeCamera(view);
  }
  /// The discs' centres as one camera sees them, as lines.
  std::string Points(const CameraModel& camera, double noise_px) {
    std::string text = "# X Y Z u v\n";
    for (const ReferenceDisc& disc : object_.discs) {
      const Eigen::Vector3d& p = disc.centre_m;
      const Eigen::Vector2d px = camera.Project(p);
      char line[200];
      std::snprintf(line, sizeof line, "%.6f %.6f %.6f %.4f %.4f\n", p.x(), p.y(), p.z(),
                    px.x() + rng_.Normal(noise_px), px.y() + rng_.Normal(noise_px));
      text += line;
    }
    return text;
  }
  std::string ReasonOf(const OfflineCalibration& input) const {
    try {
      CalibrateFromFiles(input);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  std::string ReasonOfPoints(const std::string& text) const {
    OfflineCalibration input;
    input.points = {Write("points.txt", text)};
    return ReasonOf(input);
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("priamos-offline-" + std::to_string(getpid()));
  const ReferenceObject object_ = support::ShippedReferenceObject();
  Rng rng_{4};
};

TEST_F(OfflineCalibrationTest, TwoListsOfPointsGiveTwoCamerasAndTheObject) {
  OfflineCalibration input;
  input.points = {Write("left.txt", Points(Camera(-0.1), 0.1)), Write("right.txt", Points(Camera(0.1), 0.1))};
  const json dut = json::parse(CalibrateFromFiles(input).json);
  ASSERT_EQ(dut["cameras"].size(), 2u);
  const json& left = dut["cameras"][0];
  EXPECT_EQ(left["points"], 16);
  EXPECT_LT(left["F_px"], 0.2);
  EXPECT_GT(left["leave_one_out_F_px"], left["F_px"]);
  EXPECT_NEAR(left["K"][0][0], 1000, 30);
  EXPECT_EQ(dut["stereo"]["points"], 16);
  EXPECT_LT(dut["stereo"]["rms_m"], 0.002);
}

TEST_F(OfflineCalibrationTest, OneCameraHasNoStereo) {
  OfflineCalibration input;
  input.points = {Write("left.txt", Points(Camera(0), 0.1))};
  EXPECT_TRUE(json::parse(CalibrateFromFiles(input).json)["stereo"].is_null());
}

TEST_F(OfflineCalibrationTest, PhotographsOfTheObjectGiveACameraEach) {
  OfflineCalibration input;
  input.object = PRIAMOS_SOURCE_DIR "/config/sim/reference_object.toml";
  for (const double azimuth : {-0.1, 0.1}) {
    support::DiscRenderer scene(768, 576, 25, 2);
    for (const ReferenceDisc& disc : object_.discs) scene.AddDisc(Camera(azimuth), disc, 180);
    const GreyImage image = scene.Expose({}, rng_);
    const std::string path = folder_ / (azimuth < 0 ? "left.png" : "right.png");
    cv::imwrite(path,
                cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.pixels.data())));
    input.photographs.push_back(path);
  }
  const json dut = json::parse(CalibrateFromFiles(input).json);
  EXPECT_LT(dut["cameras"][1]["F_px"], 0.03);
  EXPECT_LT(dut["stereo"]["rms_m"], 0.0002);
}

/// A photograph of the flat target of dots, straight from before.
cv::Mat DotsAt(int left_px) {
  cv::Mat image(400, 400, CV_8UC1, cv::Scalar(220));
  for (int i = 0; i < 36; ++i)
    cv::circle(image, {left_px + 50 * (i % 6), 70 + 50 * (i / 6)}, 16, cv::Scalar(30), cv::FILLED,
               cv::LINE_AA);
  cv::GaussianBlur(image, image, {}, 0.8);
  return image;
}

TEST_F(OfflineCalibrationTest, APhotographGivenAgainIsNoOtherView) {
  OfflineCalibration input;
  for (const auto& [name, left_px] :
       std::map<std::string, int>{{"a.png", 70}, {"b.png", 70}, {"c.png", 80}}) {
    cv::imwrite(folder_ / name, DotsAt(left_px));
    input.photographs.push_back(folder_ / name);
  }
  EXPECT_THAT(ReasonOf(input), HasSubstr("c.png: expected photographs of at least 3 different views of the "
                                         "target, got 3 photographs of 2"));
  input.photographs.assign(4, folder_ / "a.png");
  EXPECT_THAT(ReasonOf(input), HasSubstr("different views of the target, got 4 photographs of 1"));
  input.photographs.resize(1);
  EXPECT_THAT(ReasonOf(input), HasSubstr("1 photographs of a flat target, expected at least 3"));
}

TEST_F(OfflineCalibrationTest, BadListsAreRefusedWithFileAndLine) {
  const std::string good = Points(Camera(0), 0.1);
  EXPECT_THAT(ReasonOfPoints("1 2 3 4\n"), HasSubstr("points.txt:1: expected five numbers"));
  EXPECT_THAT(ReasonOfPoints(good + "nan 0 0 1 1\n"),
              HasSubstr("points.txt:18: expected five finite numbers"));
  EXPECT_THAT(ReasonOfPoints(good.substr(0, 200)), HasSubstr("points.txt"));
  EXPECT_THAT(ReasonOfPoints(""), HasSubstr("6"));
  OfflineCalibration missing;
  missing.points = {folder_ / "none.txt"};
  EXPECT_THAT(ReasonOf(missing), HasSubstr("none.txt: expected a list of points, got none"));
}

TEST_F(OfflineCalibrationTest, SwappedColumnsAreRefused) {
  std::string swapped;
  std::istringstream lines(Points(Camera(0.2), 0.1));
  std::string line;
  std::getline(lines, line);
  double x, y, z, u, v;
  while (lines >> x >> y >> z >> u >> v)
    swapped += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " " +
               std::to_string(v) + " " + std::to_string(u) + "\n";
  EXPECT_THAT(ReasonOfPoints(swapped), HasSubstr("mirror"));
}

TEST_F(OfflineCalibrationTest, ImagesThatCannotBeReadAreRefused) {
  OfflineCalibration input;
  input.photographs = {Write("no.png", "this is no picture")};
  EXPECT_THAT(ReasonOf(input), HasSubstr("no.png: expected an image"));
  input.photographs = {folder_ / "missing.pgm"};
  EXPECT_THAT(ReasonOf(input), HasSubstr("missing.pgm: expected an image"));
}

}  // namespace
}  // namespace priamos::head
