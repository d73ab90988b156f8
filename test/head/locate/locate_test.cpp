#include "head/locate/locate.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "head/see/see_landmark.hpp"
#include "test/head/core/bodies/grey_cupboard.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using support::ThrownReason;
using testing::HasSubstr;

/// A film of a cupboard that moves to the right, taken by a camera of a file.
class LocateTest : public testing::Test {
 protected:
  LocateTest() {
    camera_.image_from_base << 600, 0, 384, 0, 0, 600, 288, 0, 0, 0, 1, 0;
    camera_.centre_px = {384, 288};
    camera_.scale_px = 600;
    std::ofstream(folder_ / "camera.yaml")
        << "image_width: 768\nimage_height: 576\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
           "  data: [600, 0, 384, 0, 600, 288, 0, 0, 1]\n";
    std::ofstream model(folder_ / "cupboard.obj");
    for (const auto& p : cupboard_.body.points)
      model << "v " << 1000 * p.x() << ' ' << 1000 * p.y() << ' ' << 1000 * p.z() << '\n';
    for (const auto& face : cupboard_.body.faces) {
      model << "f";
      for (const int corner : face) model << ' ' << corner + 1;
      model << '\n';
    }
    std::filesystem::create_directory(folder_ / "film");
    std::filesystem::create_directory(folder_ / "drawn");
    for (int i = 0; i < 4; ++i)
      cv::imwrite(Image(i), test::RenderQuads(cupboard_.quads, PoseAt(i), camera_, 2, rng_, 60));
  }

  /// Below the camera, so that the front, a side and the top are seen.
  static Eigen::Isometry3d PoseAt(int i) {
    Eigen::Isometry3d pose(Eigen::Translation3d(-0.3 + 0.04 * i, 1.5, 3.6));
    Eigen::Matrix3d upright;  // x of the cupboard is forward, z is up
    upright << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    pose.rotate(upright * Eigen::AngleAxisd(0.6 + 0.02 * i, Eigen::Vector3d::UnitZ()));
    return pose;
  }
  static std::vector<double> At(int i) {
    const auto six = SixFromPose(PoseAt(i));
    return {six.begin(), six.end()};
  }
  std::string Image(int i) const { return folder_ / ("film/" + std::to_string(i + 8) + ".png"); }

  LocateOptions Options() const {
    LocateOptions options;
    options.images = {folder_ / "film"};
    options.cameras = {folder_ / "camera.yaml"};
    options.model = folder_ / "cupboard.obj";
    options.scale = 0.001;
    options.at = At(0);
    options.json = "-";
    return options;
  }

  LocateTally Run(const LocateOptions& options, const std::string& lines = "") {
    text_.clear();
    poses_.clear();
    std::istringstream names(lines);
    const LocateSinks sinks{
        [this](const std::string& line) { text_ += line; },
        [this](const std::string& line) { poses_.push_back(nlohmann::json::parse(line)); }};
    return Locate(options, names, sinks);
  }

  TemporaryFolder folder_;
  test::GreyCupboard cupboard_;
  CameraModel camera_;
  Rng rng_{5};
  std::string text_;
  std::vector<nlohmann::json> poses_;
};

TEST_F(LocateTest, FollowsABodyThroughAFolderOfImages) {
  const LocateTally tally = Run(Options());
  EXPECT_EQ(tally.n_moments, 4);
  ASSERT_EQ(tally.n_found, 4) << text_;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(poses_[i]["images"][0], Image(i)) << "8 and 9 come before 10";
    const std::vector<double> at = poses_[i]["pose_m_deg"];
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(at[k], At(i)[k], 0.02) << i;
    EXPECT_GT(poses_[i]["sigma_m"][2], 0);
  }
  EXPECT_THAT(text_, HasSubstr("found in 4 of 4 images"));
}

TEST_F(LocateTest, DrawsEachImageAndKeepsWhatIsThere) {
  LocateOptions options = Options();
  options.draw = folder_ / "drawn";
  options.json = folder_ / "poses.jsonl";
  Run(options);
  EXPECT_EQ(cv::imread(folder_ / "drawn/8-body.png").cols, 768);
  std::ifstream in(options.json);
  std::string line;
  int n = 0;
  for (; std::getline(in, line); ++n) EXPECT_TRUE(nlohmann::json::accept(line));
  EXPECT_EQ(n, 4);
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("--force replaces it"));
  options.force = true;
  EXPECT_EQ(Run(options).n_found, 4);
}

TEST_F(LocateTest, AnImageThatCannotBeReadIsAMomentWithoutTheBody) {
  std::ofstream(Image(1)) << "no image";
  const LocateTally tally = Run(Options());
  EXPECT_EQ(tally.n_moments, 4);
  EXPECT_EQ(tally.n_found, 3) << text_;
  EXPECT_FALSE(poses_[1]["found"]);
  EXPECT_EQ(poses_[1]["lost"], 1);
  EXPECT_THAT(text_, HasSubstr("9.png: not found"));
}

TEST_F(LocateTest, ABadBeginningIsNotTheEnd) {
  std::ofstream(Image(0)) << "no image";
  ASSERT_EQ(mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  LocateOptions options = Options();
  options.images = {folder_ / "none.png", folder_ / "pipe.png", folder_ / "film"};
  EXPECT_EQ(Run(options).n_found, 3) << text_;
  options.images = {folder_ / "none.png", folder_ / "pipe.png"};
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("none.png: expected an image, got none"));
}

TEST_F(LocateTest, WhatIsReadIsNeverReplaced) {
  LocateOptions options = Options();
  options.force = true;
  std::filesystem::create_directory(folder_ / "second");
  std::filesystem::copy_file(Image(1), folder_ / "second/8.png");
  options.images = {Image(0), folder_ / "second/8.png"};
  options.draw = folder_ / "drawn";
  EXPECT_EQ(Run(options).n_found, 2) << text_;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "drawn/8-2-body.png")) << "two images of one name";
  options.images = {Image(0), folder_ / "drawn/8-body.png"};
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("expected another file to write"));
  options.images = {"-"};
  Run(options, Image(0) + "\n" + std::string(folder_ / "drawn/8-body.png") + "\n");
  EXPECT_THAT(text_, HasSubstr("got a drawing of this run"));
  std::ofstream(folder_ / "all.cao") << "V1\nload(\"part.cao\")\n0\n0\n0\n0\n";
  std::ofstream(folder_ / "part.cao") << "V1\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0\n0\n1\n4 0 1 2 3\n0\n0\n";
  options = Options();
  options.force = true;
  options.model = folder_ / "all.cao";
  options.json = folder_ / "part.cao";
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("expected another file to write"));
}

TEST_F(LocateTest, NamesComeLineByLine) {
  LocateOptions options = Options();
  options.images = {"-"};
  EXPECT_EQ(Run(options, Image(0) + "\n" + Image(1) + "\n").n_found, 2);
}

TEST_F(LocateTest, HowExactTheModelIsWeighsItsEdgesAndHowTheyFitTellsTheRest) {
  ASSERT_EQ(Run(Options()).n_found, 4) << text_;
  const double usual_m = poses_[0]["sigma_m"][2];
  LocateOptions options = Options();
  options.model_sigma_m = 0.0001;
  ASSERT_EQ(Run(options).n_found, 4) << text_;
  const double exact_m = poses_[0]["sigma_m"][2];
  EXPECT_NE(usual_m, exact_m);
  EXPECT_NEAR(usual_m, exact_m, 0.3 * usual_m) << "the variance found scales both";
}

TEST_F(LocateTest, WhatCannotBeUsedIsNamed) {
  LocateOptions options = Options();
  options.model = folder_ / "none.stl";
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("none.stl"));
  options = Options();
  options.images = {folder_ / "camera.yaml"};
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("camera.yaml: expected an image"));
  options = Options();
  options.draw = folder_ / "nowhere";
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("--draw"));
  options = Options();
  options.images = {"-"};
  EXPECT_THAT(ThrownReason([&] { Run(options); }), HasSubstr("expected images, got none"));
  options = Options();
  options.n_at_once = 2;
  EXPECT_NE(ThrownReason([&] { Run(options); }), "");
}

/// A camera beside the first, whose projection matrix says where it stands.
std::string CameraAt(const TemporaryFolder& folder, const std::string& name, double x_m) {
  std::ofstream(folder / name) << "image_width: 768\nimage_height: 576\ncamera_matrix:\n  rows: 3\n  cols: "
                                  "3\n  data: [600, 0, 384, 0, 600, 288, 0, 0, 1]\n"
                                  "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [600, 0, 384, "
                               << -600 * x_m << ", 0, 600, 288, 0, 0, 0, 1, 0]\n";
  return folder / name;
}

TEST_F(LocateTest, CamerasAtOnePlaceAreRefused) {
  LocateOptions options = Options();
  options.cameras = {folder_ / "camera.yaml", folder_ / "camera.yaml"};
  EXPECT_EQ(ThrownReason([&] { Run(options); }),
            options.cameras[0] + ", " + options.cameras[0] +
                ": expected cameras at different places, got two at one; say in projection_matrix where each "
                "stands");
}

TEST_F(LocateTest, OneImageForTwoCamerasOfAMomentCountsForNone) {
  LocateOptions options = Options();
  options.cameras = {CameraAt(folder_, "left.yaml", 0), CameraAt(folder_, "right.yaml", 0.3)};
  options.images = {Image(0), Image(0)};
  EXPECT_EQ(ThrownReason([&] { Run(options); }),
            Image(0) + ": expected an image of each camera, got the same file twice in one moment");
  std::filesystem::copy_file(Image(0), folder_ / "copy.png");
  options.images[1] = folder_ / "copy.png";
  EXPECT_EQ(ThrownReason([&] { Run(options); }),
            Image(0) + " and " + options.images[1] +
                ": expected an image of each camera, got the same image twice");
}

TEST_F(LocateTest, ImagesOfASequenceMayBeAlike) {
  LocateOptions options = Options();
  options.images = {Image(0), Image(0)};
  EXPECT_EQ(Run(options).n_found, 2) << text_;
}

}  // namespace
}  // namespace priamos::head
