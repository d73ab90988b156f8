// Photographs that somebody took with a camera: Debian's visp-images-data and opencv-doc, where installed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "head/files/offline_calibration.hpp"
#include "head/locate/locate.hpp"
#include "head/see/see_landmark.hpp"

namespace priamos::head {
namespace {

using nlohmann::json;

constexpr const char* kVisp = "/usr/share/visp-images-data/ViSP-images/calibration";
constexpr const char* kCube = "/usr/share/visp-images-data/ViSP-images/mbt/";
constexpr const char* kOpenCv = "/usr/share/doc/opencv-doc/examples/data";

TEST(RealPhotographsTest, AGridOfPrintedDots) {
  if (!std::filesystem::exists(kVisp)) GTEST_SKIP() << "Debian package visp-images-data is not installed";
  OfflineCalibration input;
  for (const char* name : {"grid36-01.pgm", "grid36-02.pgm", "grid36-03.pgm", "grid36-04.pgm"})
    input.photographs.push_back(std::string(kVisp) + "/" + name);
  input.target = {6, 6, 0.03, 0.0105, true};
  const json dut = json::parse(CalibrateFromFiles(input).json);
  EXPECT_EQ(dut["photographs"].size(), 4u);
  // A compressing, sharpening camera and a bent sheet of paper: 0.26 px.
  EXPECT_LT(dut["F_px"], 0.35);
  EXPECT_LT(dut["leave_one_photograph_out_F_px"], 0.45);
  EXPECT_NEAR(dut["K"][0][0], dut["K"][1][1], 15);
}

/// OpenCV's calibration of the left camera lies beside the photographs: left_intrinsics.yml has 535.9 px.
TEST(RealPhotographsTest, AChessboard) {
  if (!std::filesystem::exists(kOpenCv)) GTEST_SKIP() << "Debian package opencv-doc is not installed";
  for (const char* side : {"left", "right"}) {
    OfflineCalibration input;
    for (const int number : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14}) {
      char name[200];
      std::snprintf(name, sizeof name, "%s/%s%02d.jpg", kOpenCv, side, number);
      input.photographs.push_back(name);
    }
    input.chessboard = Chessboard{9, 6, 0.025};
    const json dut = json::parse(CalibrateFromFiles(input).json);
    EXPECT_EQ(dut["photographs"].size(), 13u);
    EXPECT_LT(dut["F_px"], 0.2) << side;
    EXPECT_LT(dut["leave_one_photograph_out_F_px"], 0.25) << side;
    EXPECT_NEAR(dut["K"][0][0], 535.9, 5) << side;
  }
}

/// A printed cube of 84 mm before a camera that is moved by hand, from the pose that ViSP gives for the first
/// image. The poses in which it was found.
std::vector<Eigen::Isometry3d> FollowTheCube(const std::vector<std::string>& images) {
  LocateOptions options;
  options.images = images;
  options.cameras = {std::string(kCube) + "cube.xml"};
  options.model = std::string(kCube) + "cube.cao";
  options.at = {0.02232, 0.10714, 0.50711, 150.01056, 36.11761, 47.28446};
  options.json = "-";
  std::vector<Eigen::Isometry3d> poses;
  const LocateSinks sinks{[](const std::string&) {},
                          [&](const std::string& line) {
                            const json moment = json::parse(line);
                            if (moment["found"]) poses.push_back(PoseFromSix(moment["pose_m_deg"]));
                          }};
  std::istringstream none;
  Locate(options, none, sinks);
  return poses;
}

void ExpectNoLeaps(const std::vector<Eigen::Isometry3d>& poses) {
  for (std::size_t i = 1; i < poses.size(); ++i)  // a false pose would be a leap
    EXPECT_LT((poses[i].translation() - poses[i - 1].translation()).norm(), 0.03) << i;
}

TEST(RealPhotographsTest, ACubeIsFollowed) {
  if (!std::filesystem::exists(kCube)) GTEST_SKIP() << "Debian package visp-images-data is not installed";
  const auto poses = FollowTheCube({std::string(kCube) + "cube"});
  EXPECT_GE(poses.size(), 185u) << "of 218";
  ExpectNoLeaps(poses);
}

TEST(RealPhotographsTest, ACubeIsFollowedInBlurredImages) {
  if (!std::filesystem::exists(kCube)) GTEST_SKIP() << "Debian package visp-images-data is not installed";
  const auto folder = std::filesystem::path(testing::TempDir()) / "blurred-cube";
  std::filesystem::create_directories(folder);
  for (int i = 0; i < 40; ++i) {
    const std::string name = fmt::format("image{:04}.pgm", i);
    cv::Mat image = cv::imread(fmt::format("{}cube/{}", kCube, name), cv::IMREAD_GRAYSCALE);
    cv::GaussianBlur(image, image, {0, 0}, 3);
    ASSERT_TRUE(cv::imwrite((folder / name).string(), image));
  }
  const auto poses = FollowTheCube({folder.string()});
  std::filesystem::remove_all(folder);
  EXPECT_GE(poses.size(), 35u) << "of 40";
  ExpectNoLeaps(poses);
}

}  // namespace
}  // namespace priamos::head
