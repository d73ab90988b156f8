#include "head/see/see.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "head/core/landmark/landmark_fix.hpp"
#include "head/files/camera_file.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::head {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFocal = 300, kBaseline = 0.12, kDepth = 2.0;
constexpr double kDisparity = kFocal * kBaseline / kDepth;  // 18 px

class SeeTest : public ::testing::Test {
 protected:
  /// A bright board 2 m before the cameras, wider than high.
  std::string Photograph(const std::string& name, double shift) {
    cv::Mat image(kHeight, kWidth, CV_8UC1, cv::Scalar(60));
    const auto left = static_cast<int>(120 - shift);
    cv::rectangle(image, {left, 70}, {left + 100, 150}, cv::Scalar(180), cv::FILLED);
    cv::GaussianBlur(image, image, {}, 0.8);
    const std::string file = folder_ / name;
    cv::imwrite(file, image);
    return file;
  }

  std::string Camera(const std::string& name, double baseline, const std::string& extra = "") {
    const std::string file = folder_ / name;
    std::ofstream(file) << "%YAML:1.0\n---\nimage_width: " << kWidth << "\nimage_height: " << kHeight
                        << "\nprojection_matrix:\n   rows: 3\n   cols: 4\n   data: [ " << kFocal
                        << ", 0., 160., " << -kFocal * baseline << ", 0., " << kFocal
                        << ", 120., 0., 0., 0., 1., 0. ]\n"
                        << extra;
    return file;
  }

  nlohmann::json SeePair() {
    See({.images = {Photograph("left.png", 0), Photograph("right.png", kDisparity)},
         .cameras = {Camera("left.yaml", 0), Camera("right.yaml", kBaseline)},
         .output = folder_.path(),
         .json = folder_ / "all.json"});
    return nlohmann::json::parse(std::ifstream(folder_ / "all.json"));
  }

  std::string ErrorOf(const SeeOptions& options) {
    try {
      See(options);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(SeeTest, ABoardIsAParallelogramWithFourCorners) {
  const auto dut = SeePair()["images"][0];
  EXPECT_EQ(dut["segments"].size(), 4u);
  EXPECT_EQ(dut["corners"].size(), 4u);
  ASSERT_EQ(dut["outlines"].size(), 1u);
  EXPECT_TRUE(dut["outlines"][0]["parallelogram"]);
}

TEST_F(SeeTest, UprightEdgesOfAPairAreInSpaceLevelOnesAreNot) {
  const auto dut = SeePair()["matches"];
  int in_space = 0, along_epipolar_lines = 0;
  for (const auto& match : dut) {
    if (!match.contains("from_m")) {
      ++along_epipolar_lines;
      continue;
    }
    ++in_space;
    EXPECT_NEAR(match["from_m"][2].get<double>(), kDepth, 0.02);
    EXPECT_NEAR(match["to_m"][2].get<double>(), kDepth, 0.02);
  }
  EXPECT_EQ(in_space, 2);
  EXPECT_EQ(along_epipolar_lines, 2);
}

TEST_F(SeeTest, DrawingsLieSideBySide) {
  SeePair();
  int stereo = 0, edges = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename();
    if (name.ends_with("-edges.png")) ++edges;
    if (!name.ends_with("-stereo.png")) continue;
    ++stereo;
    const cv::Mat drawing = cv::imread(entry.path());
    EXPECT_EQ(drawing.cols, 2 * kWidth);
    EXPECT_GT(drawing.rows, kHeight);  // the legend
  }
  EXPECT_EQ(edges, 2);
  EXPECT_EQ(stereo, 1);
}

TEST_F(SeeTest, WhatCannotBeUsedIsNamed) {
  const std::string photo = Photograph("left.png", 0);
  const std::string other = Photograph("right.png", kDisparity);
  const std::string camera = Camera("left.yaml", 0);
  const std::string missing = folder_ / "none.png";
  EXPECT_THAT(ErrorOf({.images = {missing}, .output = folder_.path()}), HasSubstr(missing));
  EXPECT_THAT(ErrorOf({.images = {photo}, .cameras = {camera, camera}, .output = folder_.path()}),
              HasSubstr("a camera for each"));
  EXPECT_THAT(ErrorOf({.images = {photo, other}, .cameras = {camera, photo}, .output = folder_.path()}),
              HasSubstr("left.png"));
  EXPECT_THAT(
      ErrorOf({.images = {photo, other},
               .cameras = {camera, Camera("bent.yaml", 0.1,
                                          "distortion_coefficients:\n   data: [ 0.1, 0., 0., 0., 0. ]\n")},
               .output = folder_.path()}),
      HasSubstr("rectified"));
}

/// The board of Photograph as a model in the left camera's frame.
constexpr const char* kBoard = R"(
[[points]]
at_m = [-0.2667, -0.3333, 2.0]
[[points]]
at_m = [0.4, -0.3333, 2.0]
[[points]]
at_m = [0.4, 0.2, 2.0]
[[points]]
at_m = [-0.2667, 0.2, 2.0]
[[faces]]
points = [0, 3, 2, 1]
)";

TEST_F(SeeTest, AnImageInWhichNothingCanBeSeenIsNamedWithTheReason) {
  const std::string file = folder_ / "bad.png", json = folder_ / "bad.json";
  for (const auto& [grey, why] :
       {std::pair{0, "black"}, {255, "black or white all over"}, {90, "without edges"}}) {
    cv::imwrite(file, cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(grey)));
    EXPECT_TRUE(See({.images = {file}, .output = folder_.path(), .force = true, .json = json}).found);
    EXPECT_EQ(nlohmann::json::parse(std::ifstream(json))["images"][0]["unusable"], why);
  }
}

TEST_F(SeeTest, ExchangedImagesAreRefused) {
  const SeeOptions options{.images = {Photograph("right.png", kDisparity), Photograph("left.png", 0)},
                           .cameras = {Camera("left.yaml", 0), Camera("right.yaml", kBaseline)},
                           .output = folder_.path()};
  EXPECT_THAT(ErrorOf(options), HasSubstr("if the images are exchanged"));
}

TEST_F(SeeTest, WithoutATargetDrawingsLieBesideTheirImages) {
  const auto before = std::filesystem::current_path();
  const TemporaryFolder elsewhere;
  std::filesystem::current_path(elsewhere.path());
  See({.images = {Photograph("left.png", 0)}});
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "left-edges.png"));
  EXPECT_TRUE(std::filesystem::is_empty(elsewhere.path()));
}

TEST_F(SeeTest, NothingIsReplacedUnasked) {
  const SeeOptions options{.images = {Photograph("left.png", 0)}};
  const std::string drawing = folder_ / "left-edges.png";
  std::ofstream(drawing) << "mine";
  EXPECT_THAT(ErrorOf(options), HasSubstr(drawing + ": is there already"));
  EXPECT_EQ(std::filesystem::file_size(drawing), 4u);
  SeeOptions forced = options;
  forced.force = true;
  EXPECT_EQ(ErrorOf(forced), "");
  EXPECT_GT(std::filesystem::file_size(drawing), 4u);
}

TEST_F(SeeTest, WhatFailsAtTheEndHasWrittenNothing) {
  const SeeOptions exchanged{.images = {Photograph("right.png", kDisparity), Photograph("left.png", 0)},
                             .cameras = {Camera("left.yaml", 0), Camera("right.yaml", kBaseline)}};
  EXPECT_NE(ErrorOf(exchanged), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "left-edges.png"));
}

TEST_F(SeeTest, FindsALandmarkOfFlatFaces) {
  std::ofstream(folder_ / "board.toml") << kBoard;
  const SeeOptions options{.images = {Photograph("left.png", 0), Photograph("right.png", kDisparity)},
                           .cameras = {Camera("left.yaml", 0), Camera("right.yaml", kBaseline)},
                           .landmark = folder_ / "board.toml",
                           .at = {0.01, -0.01, 0.02, 0, 0, 0.3},
                           .output = folder_.path(),
                           .json = folder_ / "all.json"};
  EXPECT_TRUE(See(options).found);
  const auto dut = nlohmann::json::parse(std::ifstream(folder_ / "all.json"))["landmark"];
  ASSERT_TRUE(dut["found"]) << dut["verdict"];
  EXPECT_NEAR(dut["pose_m_deg"][0].get<double>(), 0, 0.01);
  EXPECT_NEAR(dut["pose_m_deg"][2].get<double>(), 0, 0.03);
}

TEST_F(SeeTest, ALandmarkThatCannotBeSeenIsNotFoundAndTheReasonIsTold) {
  std::ofstream(folder_ / "board.toml") << kBoard;
  SeeOptions options{.images = {Photograph("left.png", 0)},
                     .cameras = {Camera("left.yaml", 0)},
                     .landmark = folder_ / "board.toml",
                     .at = {0, 0, -4, 0, 0, 0},
                     .output = folder_.path(),
                     .force = true,
                     .json = folder_ / "all.json"};
  EXPECT_FALSE(See(options).found);
  const auto verdict = [&] {
    return nlohmann::json::parse(std::ifstream(folder_ / "all.json"))["landmark"]["verdict"]
        .get<std::string>();
  };
  EXPECT_EQ(verdict(), Describe(Verdict::kNotVisible));
  cv::imwrite(options.images[0], cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(0)));
  options.at = {0, 0, 0, 0, 0, 0};
  EXPECT_FALSE(See(options).found);
  EXPECT_EQ(verdict(), Describe(Verdict::kNoImage));
}

TEST_F(SeeTest, MistakesInALandmarkFileAreNamed) {
  const std::string file = folder_ / "body.toml";
  const auto error = [&](const std::string& text, const std::string& name) {
    std::ofstream(name) << text;
    return ErrorOf({.images = {Photograph("left.png", 0)},
                    .cameras = {Camera("left.yaml", 0)},
                    .landmark = name,
                    .at = {0, 0, 0, 0, 0, 0},
                    .output = folder_.path()});
  };
  EXPECT_THAT(error("[[points]]\nat_m = [0, 0]\n", file), HasSubstr("body.toml:2"));
  EXPECT_THAT(error("[[faces]]\npoints = [0, 1.5, 2]\n", file), HasSubstr("whole numbers"));
  EXPECT_THAT(error("[[faces]]\npoints = [0, 1, 2]\n", file), HasSubstr("expected points 0 to"));
  EXPECT_THAT(error("colour = 3\n", file), HasSubstr("colour"));
  EXPECT_THAT(error("V2\n", folder_ / "body.cao"), HasSubstr("body.cao:1: expected V1"));
  EXPECT_THAT(error("", folder_ / "body.ply"), HasSubstr(".toml, .cao, .obj or .stl"));
}

TEST_F(SeeTest, ACameraOfAnotherImageIsRefused) {
  const std::string camera = Camera("left.yaml", 0);
  EXPECT_NO_THROW(LoadCameras({camera}, 1, {{kWidth, kHeight}}));
  EXPECT_THROW(LoadCameras({camera}, 1, {{kWidth + 1, kHeight}}), std::runtime_error);
}

/// A framed door 3 m before the cameras, which stand 1.2 m above the floor.
class SeeDoorTest : public SeeTest {
 protected:
  std::string PhotographOfADoor(const std::string& name, double left_m) {
    constexpr int kScale = 4;  // drawn larger, for edges between pixels
    cv::Mat image(kScale * 480, kScale * 640, CV_8UC1, cv::Scalar(180));
    const auto box = [&](double half, double top, double bottom, int grey) {
      const auto px = [&](double x, double z) {
        return cv::Point(static_cast<int>(kScale * (320.5 + 500 * (x - left_m) / 3)),
                         static_cast<int>(kScale * (240.5 + 500 * (1.2 - z) / 3)));
      };
      cv::rectangle(image, px(-half, top), px(half, bottom), cv::Scalar(grey), cv::FILLED);
    };
    box(10, 0, -1, 100);
    box(0.51, 2.06, 0, 90);
    box(0.45, 2.0, 0, 140);
    cv::resize(image, image, {640, 480}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(image, image, {}, 0.7);
    cv::imwrite(folder_ / name, image);
    return folder_ / name;
  }
  std::string LargeCamera(const std::string& name, double baseline) {
    std::ofstream(folder_ / name) << "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n"
                                  << "projection_matrix:\n   rows: 3\n   cols: 4\n   data: [ 500., 0., 320., "
                                  << -500 * baseline << ", 0., 500., 240., 0., 0., 0., 1., 0. ]\n";
    return folder_ / name;
  }
  SeeOptions Options() {
    return {.images = {PhotographOfADoor("left.png", 0), PhotographOfADoor("right.png", 0.2)},
            .cameras = {LargeCamera("left.yaml", 0), LargeCamera("right.yaml", 0.2)},
            .stand = {1.2},
            .output = folder_.path(),
            .json = folder_ / "all.json"};
  }
};

TEST_F(SeeDoorTest, ADoorIsListedAndDrawn) {
  See(Options());
  const auto dut = nlohmann::json::parse(std::ifstream(folder_ / "all.json"))["doors"];
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_NEAR(dut[0]["middle_m"][0], 3.0, 0.05);
  EXPECT_NEAR(dut[0]["middle_m"][1], 0.0, 0.02);
  EXPECT_NEAR(dut[0]["width_m"], 0.96, 0.08);
  int drawings = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder_.path()))
    if (file.path().string().ends_with("left-doors.png")) {
      ++drawings;
      EXPECT_EQ(cv::imread(file.path().string()).cols, 2 * 640);
    }
  EXPECT_EQ(drawings, 1);
}

TEST_F(SeeDoorTest, TheHeadsTableIsOfBothImages) {
  SeeOptions options = Options();
  for (const std::string& image : options.images) {
    cv::Mat larger;
    cv::resize(cv::imread(image, cv::IMREAD_GRAYSCALE), larger, {768, 576});
    cv::imwrite(image, larger);
  }
  options.cameras = {PRIAMOS_SOURCE_DIR "/config/sim/kastor.yaml"};
  options.stand.clear();
  EXPECT_THAT(See(options).text, HasSubstr("left-stereo.png"));
}

TEST_F(SeeDoorTest, WithoutAStandNoDoorsAreLookedFor) {
  SeeOptions options = Options();
  options.stand.clear();
  See(options);
  EXPECT_FALSE(nlohmann::json::parse(std::ifstream(folder_ / "all.json")).contains("doors"));
}

TEST_F(SeeDoorTest, OneImageTellsDirectionAndShapeOfADoor) {
  SeeOptions options = Options();
  options.images.resize(1);
  options.cameras.resize(1);
  options.doors = true;
  const SeeReport report = See(options);
  EXPECT_TRUE(report.found);
  EXPECT_THAT(report.text, HasSubstr("doors: 1, drawn in"));
  EXPECT_THAT(report.text, HasSubstr("how the camera stands: tilt"));
  const auto dut = nlohmann::json::parse(std::ifstream(folder_ / "all.json"));
  EXPECT_NEAR(dut["stand"]["tilt_deg"], 0, 0.5);
  EXPECT_EQ(dut["stand"]["height_m"], 1.2) << "as told";
  ASSERT_EQ(dut["doors"].size(), 1u);
  EXPECT_NEAR(dut["doors"][0]["range_m"], 3.0, 0.15);
  EXPECT_NEAR(dut["doors"][0]["yaw_deg"], 0, 2);
  EXPECT_NEAR(dut["doors"][0]["width_over_height"], 0.48, 0.05);
  EXPECT_EQ(dut["doors"][0]["corners_px"].size(), 2u);
}

TEST_F(SeeDoorTest, NoDoorIsWiderThanWasAsked) {
  SeeOptions options = Options();
  options.doors = true;
  options.max_door_width_m = 0.7;
  options.force = true;
  for (const std::size_t images : {2, 1}) {
    options.images.resize(images);
    options.cameras.resize(images);
    See(options);
    EXPECT_TRUE(nlohmann::json::parse(std::ifstream(folder_ / "all.json"))["doors"].empty()) << images;
  }
}

TEST_F(SeeDoorTest, APairTellsHowItStands) {
  SeeOptions options = Options();
  options.stand.clear();
  options.doors = true;
  EXPECT_THAT(See(options).text, HasSubstr("above the floor"));
  const auto dut = nlohmann::json::parse(std::ifstream(folder_ / "all.json"));
  EXPECT_NEAR(dut["stand"]["height_m"], 1.2, 0.1);
  ASSERT_EQ(dut["doors"].size(), 1u);
  EXPECT_NEAR(dut["doors"][0]["middle_m"][0], 3.0, 0.06);
}

TEST_F(SeeTest, WhereNothingIsUprightDoorsAreNotLookedFor) {
  cv::Mat flat(kHeight, kWidth, CV_8UC1, cv::Scalar(90));
  cv::imwrite(folder_ / "flat.png", flat);
  const SeeReport dut = See({.images = {folder_ / "flat.png"},
                             .cameras = {Camera("left.yaml", 0)},
                             .doors = true,
                             .output = folder_.path()});
  EXPECT_FALSE(dut.found);
  EXPECT_THAT(dut.text, HasSubstr("not known, too few upright edges"));
}

TEST_F(SeeDoorTest, DoorsNeedCamerasAboveTheFloor) {
  SeeOptions options = Options();
  options.stand = {-1.0};
  EXPECT_THAT(ErrorOf(options), HasSubstr("0.1 to 10 m"));
  options.stand = {1.2};
  options.cameras.clear();
  EXPECT_THAT(ErrorOf(options), HasSubstr("one or two images"));
}

}  // namespace
}  // namespace priamos::head
