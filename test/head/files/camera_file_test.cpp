#include "head/files/camera_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <filesystem>
#include <fstream>

#include "head/core/camera/projection.hpp"
#include "head/files/calibration_file.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kSize = "image_width: 320\nimage_height: 240\n";
constexpr const char* kMatrix =
    "projection_matrix:\n   rows: 3\n   cols: 4\n"
    "   data: [ 300, 0., 160.5, -36., 0., 310, 120.25, 2., 0., 0., 1., 0.5 ]\n";
constexpr const char* kOpenCv = "/usr/share/doc/opencv-doc/examples/data/left_intrinsics.yml";

class CameraFileTest : public testing::Test {
 protected:
  std::string Write(const std::string& text, const std::string& name = "left.yaml") const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static CameraModel Load(const std::string& file, bool are_rectified = false, ImageSize size = {320, 240}) {
    const auto cameras = LoadCameras({file}, 1, {size, are_rectified});
    EXPECT_EQ(cameras.size(), 1u);
    return cameras.at(0);
  }
  /// Why the file with this text is refused for an image of 320 by 240 pixels, without its name.
  std::string ReasonOf(const std::string& text) const {
    const std::string file = Write(text);
    const std::string reason = support::ThrownReason([&] { Load(file); });
    EXPECT_THAT(reason, StartsWith(file + ":"));
    return reason.size() > file.size() ? reason.substr(file.size() + 1) : "";
  }
  static std::string Matrix(const std::string& numbers) {
    return "projection_matrix:\n   rows: 3\n   cols: 4\n   data: [ " + numbers + " ]\n";
  }

  TemporaryFolder folder_;
};

/// A camera of every kind of lens as each notation has it.
constexpr const char* kRos = R"(image_width: 320
image_height: 240
camera_name: narrow_stereo/left
camera_matrix:
  rows: 3
  cols: 3
  data: [300.5, 0, 160.25, 0, 301.5, 120.75, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.25, 0.125, 0.001,
         -0.002, 0.03]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [290, 0, 155, -29, 0, 290, 118, 0, 0, 0, 1, 0]
)";

TEST_F(CameraFileTest, RosCameraInfoOfImagesAsTheyWereTaken) {
  const CameraModel dut = Load(Write(kRos));
  Eigen::Matrix<double, 3, 4> expected;
  expected << 300.5, 0, 160.25, -30.05, 0, 301.5, 120.75, 0, 0, 0, 1, 0;
  EXPECT_LT((dut.image_from_base - expected).norm(), 1e-9) << "0.1 m to the right of the left one";
  EXPECT_EQ(dut.centre_px, Eigen::Vector2d(160.25, 120.75));
  EXPECT_EQ(dut.scale_px, 300.5);
  EXPECT_EQ(dut.k1, -0.25);
  EXPECT_EQ(dut.k2, 0.125);
  EXPECT_EQ(dut.bend.p1, 0.001);
  EXPECT_EQ(dut.bend.p2, -0.002);
  EXPECT_EQ(dut.bend.k3, 0.03);
  EXPECT_DOUBLE_EQ(dut.bend.aspect, 301.5 / 300.5);
}

TEST_F(CameraFileTest, RosCameraInfoOfRectifiedImages) {
  const CameraModel dut = Load(Write(kRos), true);
  EXPECT_EQ(dut.image_from_base(0, 0), 290);
  EXPECT_EQ(dut.image_from_base(0, 3), -29);
  EXPECT_EQ(dut.k1, 0);
  EXPECT_TRUE(dut.IsRadial());
}

TEST_F(CameraFileTest, ATurnedCameraStandsInTheRectifiedFrame) {
  std::string text = kRos;
  const std::string upright = "data: [1, 0, 0, 0, 1, 0, 0, 0, 1]";
  text.replace(text.find(upright), upright.size(), "data: [0.8, 0, -0.6, 0, 1, 0, 0.6, 0, 0.8]");
  const CameraModel raw = Load(Write(text)), rectified = Load(Write(text), true);
  EXPECT_LT((OpticalCentre(raw) - OpticalCentre(rectified)).norm(), 1e-9);
  // What lies on its own axis is seen in its own centre: R turns from the camera into the rectified frame.
  const Eigen::Vector3d axis(-0.6, 0, 0.8);
  EXPECT_LT((raw.Project(OpticalCentre(raw) + 3 * axis) - raw.centre_px).norm(), 1e-9);
}

TEST_F(CameraFileTest, APrintedMessageOfRos) {
  const CameraModel dut = Load(Write(
      "header: \n  seq: 7\n  frame_id: \"left\"\nheight: 240\nwidth: 320\ndistortion_model: \"plumb_bob\"\n"
      "D: [-0.1, 0.0, 0.0, 0.0, 0.0]\nK: [300.0, 0.0, 160.0, 0.0, 300.0, 120.0, 0.0, 0.0, 1.0]\n"
      "R: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\n"
      "P: [300.0, 0.0, 160.0, 0.0, 0.0, 300.0, 120.0, 0.0, 0.0, 0.0, 1.0, 0.0]\nroi: \n  x_offset: 0\n---\n"
      "header: \n  seq: 8\n"));
  EXPECT_EQ(dut.k1, -0.1);
  EXPECT_EQ(dut.image_from_base(1, 2), 120);
}

TEST_F(CameraFileTest, OpenCvYamlWithAndWithoutItsFirstLine) {
  const std::string body =
      "image_width: 320\nimage_height: 240\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: "
      "d\n"
      "   data: [ 3.005e+02, 0., 160.25, 0., 300.5, 120.75, 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 8\n   cols: 1\n   dt: d\n"
      "   data: [ 0.1, 0.2, 0., 0., 0.3, 0.4,\n       0.5, 0.6 ]\n";
  for (const char* head :
       {"", "%YAML:1.0\n", "%YAML:1.0\n---\n", "---\n", "%YAML 1.2\n---\n", "\xef\xbb\xbf"}) {
    const CameraModel dut = Load(Write(head + body));
    EXPECT_EQ(dut.image_from_base(0, 0), 300.5) << head;
    EXPECT_EQ(dut.k2, 0.2);
    EXPECT_EQ(dut.bend.k4, 0.4);
    EXPECT_EQ(dut.bend.k6, 0.6);
  }
}

TEST_F(CameraFileTest, OpenCvXml) {
  const std::string body =
      "<opencv_storage>\n<image_width>320</image_width>\n<image_height>240</image_height>\n"
      "<cameraMatrix type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n"
      "  <data>\n    300.5 0. 160.25 0. 300.5\n    120.75 0. 0. 1.</data></cameraMatrix>\n"
      "<distCoeffs type_id=\"opencv-matrix\"><data>\n    -0.1 0.05 0. "
      "0.</data></distCoeffs>\n</opencv_storage>\n";
  for (const char* head : {"", "<?xml version=\"1.0\"?>\n"}) {
    const CameraModel dut = Load(Write(head + body, "camera.xml"));
    EXPECT_EQ(dut.image_from_base(1, 2), 120.75);
    EXPECT_EQ(dut.k1, -0.1);
    EXPECT_TRUE(dut.IsRadial());
  }
}

TEST_F(CameraFileTest, TheCalibrationThatComesWithOpenCv) {
  if (!std::filesystem::exists(kOpenCv)) GTEST_SKIP() << "Debian package opencv-doc is not installed";
  const CameraModel dut = Load(kOpenCv, false, {640, 480});
  EXPECT_NEAR(dut.scale_px, 535.916, 1e-3);
  EXPECT_NEAR(dut.bend.k3, 0.2384, 1e-4);
}

/// As vpXmlParserCamera writes it.
constexpr const char* kVisp = R"(<?xml version="1.0"?>
<root>
  <!--This file stores intrinsic camera parameters used
   in the vpCameraParameters Class of ViSP-->
  <camera>
    <name>Camera</name>
    <image_width>320</image_width>
    <image_height>240</image_height>
    <model>
      <type>perspectiveProjWithoutDistortion</type>
      <px>310</px><py>311</py><u0>161</u0><v0>121</v0>
    </model>
    <model>
      <type>perspectiveProjWithDistortion</type>
      <px>300.5</px><py>301.5</py><u0>160.25</u0><v0>120.75</v0>
      <kud>-0.125</kud>
      <kdu>0.13</kdu>
    </model>
  </camera>
</root>
)";

TEST_F(CameraFileTest, VispModelWithDistortion) {
  const CameraModel dut = Load(Write(kVisp, "camera.xml"));
  Eigen::Matrix3d expected;
  expected << 300.5, 0, 160.25, 0, 301.5, 120.75, 0, 0, 1;
  EXPECT_EQ((dut.image_from_base.leftCols<3>()), expected);
  EXPECT_EQ(dut.k1, -0.125);
  // u = u0 + px x (1 + kud r^2), and v likewise.
  const Eigen::Vector2d seen = dut.Distort(dut.Project({0.2, 0.1, 1}));
  EXPECT_NEAR(seen.x(), 160.25 + 300.5 * 0.2 * (1 - 0.125 * 0.05), 1e-9);
  EXPECT_NEAR(seen.y(), 120.75 + 301.5 * 0.1 * (1 - 0.125 * 0.05), 1e-9);
}

TEST_F(CameraFileTest, TheCameraOfAVispTrackersConfiguration) {
  const CameraModel dut =
      Load(Write("<?xml version=\"1.0\"?>\n<conf><ecm><mask><size>5</size></mask></ecm>\n"
                 "<camera><u0>160.5</u0><v0>120</v0><px>310</px><py>311</py></camera></conf>\n",
                 "tracker.xml"));
  EXPECT_EQ(dut.image_from_base(0, 0), 310);
  EXPECT_EQ(dut.image_from_base(1, 1), 311);
  EXPECT_EQ(dut.image_from_base(0, 2), 160.5);
}

TEST_F(CameraFileTest, VispKindsOfProjectionThatAreNotKnownAreNamed) {
  std::string text = kVisp;
  for (const char* word : {"perspectiveProjWithoutDistortion", "perspectiveProjWithDistortion"})
    text.replace(text.find(word), std::string(word).size(), "ProjWithKannalaBrandtDistortion");
  EXPECT_THAT(ReasonOf(text), AllOf(StartsWith("10: camera/model/type: "), HasSubstr("KannalaBrandt")));
}

TEST_F(CameraFileTest, ACalibrationFromPhotographs) {
  const CameraModel dut = Load(Write(
      R"({"photographs": [{"name": "a.png", "points": 54}], "F_px": 0.1, "image_width": 320, "image_height": 240,
          "K": [[300, 0.1, 160], [0, 301, 120], [0, 0, 1]], "k1": -0.2, "k2": 0.1})"));
  EXPECT_EQ(dut.image_from_base(0, 1), 0.1);
  EXPECT_EQ(dut.image_from_base(1, 1), 301);
  EXPECT_EQ(dut.k1, -0.2);
  EXPECT_EQ(dut.scale_px, 300);
  EXPECT_EQ(dut.centre_px, Eigen::Vector2d(160, 120));
  EXPECT_TRUE(dut.IsRadial());
}

TEST_F(CameraFileTest, ACalibrationOfSeveralCamerasStandsInTheFirst) {
  const auto camera = [](double x_m) {
    return fmt::format(
        R"({{"K": [[300, 0, 160], [0, 300, 120], [0, 0, 1]], "k1": 0, "k2": 0, "image_width": 320,
        "image_height": 240, "image_from_points": [[300, 0, 160, {}], [0, 300, 120, 240], [0, 0, 1, 2]]}})",
        320 - 300 * x_m);
  };
  const std::string file =
      Write(fmt::format(R"({{"cameras": [{}, {}], "stereo": null}})", camera(0.5), camera(0.7)));
  const auto dut = LoadCameras({file}, 2, {{320, 240}});
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_LT(OpticalCentre(dut[0]).norm(), 1e-9);
  EXPECT_LT((OpticalCentre(dut[1]) - Eigen::Vector3d(0.2, 0, 0)).norm(), 1e-9);
}

TEST_F(CameraFileTest, TheTableOfTheHead) {
  const std::string table = PRIAMOS_SOURCE_DIR "/config/sim/kastor.yaml";
  const auto dut = LoadCameras({table}, 3, {ImageSize{}});
  ASSERT_EQ(dut.size(), 3u);
  EXPECT_LT(OpticalCentre(dut[0]).norm(), 1e-9);
  EXPECT_NEAR(OpticalCentre(dut[1]).x(), 0.3, 0.02) << "to the right";
  EXPECT_NEAR(OpticalCentre(dut[1]).z(), 0, 0.02);
  EXPECT_EQ(dut[0].k1, LoadHeadModel(table).lenses[kLeft].nodes().front().k1);
  EXPECT_THAT(support::ThrownReason([&] { LoadCameras({table}, 2, {{320, 240}}); }), HasSubstr("768x576"));
}

TEST_F(CameraFileTest, AProjectionMatrixAloneBelongsToRectifiedImages) {
  const CameraModel dut = Load(Write(std::string(kSize) + kMatrix));
  Eigen::Matrix<double, 3, 4> expected;
  expected << 300, 0, 160.5, -36, 0, 310, 120.25, 2, 0, 0, 1, 0.5;
  EXPECT_EQ(dut.image_from_base, expected);
  EXPECT_EQ(dut.centre_px, Eigen::Vector2d(159.5, 119.5));
  EXPECT_EQ(dut.Distort({10, 20}), Eigen::Vector2d(10, 20));
  const auto with = [](const std::string& numbers) {
    return std::string(kSize) + kMatrix + "distortion_coefficients:\n   data: [ " + numbers + " ]\n";
  };
  EXPECT_NO_THROW(Load(Write(with("0., 0., 0, 0., 0."))));
  EXPECT_THAT(ReasonOf(with("0., 0., 0., 0., 1e-3")),
              AllOf(StartsWith("8: distortion_coefficients/data: expected a camera_matrix"),
                    HasSubstr("--rectified")));
  EXPECT_NO_THROW(Load(Write(with("0., 0., 0., 0., 1e-3")), true)) << "said to be rectified";
}

TEST_F(CameraFileTest, OtherLensesAreRefused) {
  std::string fish = kRos;
  fish.replace(fish.find("plumb_bob"), 9, "equidistant");
  EXPECT_THAT(ReasonOf(fish), AllOf(StartsWith("8: distortion_model: "), HasSubstr("equidistant")));
  std::string prism = kRos;
  prism.replace(prism.find("0.03]"), 5, "0.03, 0, 0, 0, 1e-4, 0, 0, 0]");
  EXPECT_THAT(ReasonOf(prism), HasSubstr("thin prism"));
  std::string six = kRos;
  six.replace(six.find("0.03]"), 5, "0.03, 1]");
  EXPECT_THAT(ReasonOf(six), AllOf(StartsWith("12: distortion_coefficients/data: "), HasSubstr("got 6")));
}

TEST_F(CameraFileTest, ACameraOfAnotherImageIsRefusedWithBothSizes) {
  EXPECT_EQ(ReasonOf(std::string("image_width: 640\nimage_height: 480\n") + kMatrix),
            "1: image_width: expected the image's size of 320x240, got 640x480");
  EXPECT_THAT(ReasonOf(std::string("image_width: 320\nimage_height: 241\n") + kMatrix), EndsWith("320x241"));
}

TEST_F(CameraFileTest, WithoutAWholeSizeItIsRefused) {
  EXPECT_EQ(ReasonOf(kMatrix), " image_width: expected a number, got none");
  EXPECT_EQ(ReasonOf(std::string("image_width: 320\n") + kMatrix),
            " image_height: expected a number, got none");
  EXPECT_EQ(ReasonOf(std::string("image_width: wide\nimage_height: 240\n") + kMatrix),
            "1: image_width: expected a number, got \"wide\"");
}

TEST_F(CameraFileTest, MatricesNeedTheirNumbers) {
  EXPECT_EQ(ReasonOf(kSize), " projection_matrix: expected 12 numbers, got none");
  EXPECT_EQ(ReasonOf(kSize + Matrix("1, 2, 3")), "6: projection_matrix/data: expected 12 numbers, got 3");
  EXPECT_EQ(ReasonOf(std::string(kSize) + "projection_matrix: 5\n"),
            "3: projection_matrix: expected 12 numbers, got 1");
  EXPECT_EQ(ReasonOf(kSize + Matrix("300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 1, one")),
            "6: projection_matrix/data: expected 12 numbers, got \"one\"");
  EXPECT_EQ(ReasonOf(kSize + Matrix("300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 1, .Inf")),
            "6: projection_matrix/data: expected 12 numbers, got \".Inf\"");
  EXPECT_EQ(ReasonOf(kSize + Matrix("300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 0, 1")),
            "6: projection_matrix/data: expected a camera, got a singular matrix");
  EXPECT_THAT(ReasonOf(std::string(kSize) + "K: [300, 0, 160, 0, -300, 120, 0, 0, 1]\n"),
              AllOf(StartsWith("3: K: expected fu, skew"), HasSubstr("above 0")));
}

TEST_F(CameraFileTest, FocalLengthsThatNoLensHasAreRefused) {
  for (const char* focal : {"1", "6e8"})
    EXPECT_THAT(
        ReasonOf(fmt::format("{}K: [{}, 0, 160, 0, 300, 120, 0, 0, 1]\n", kSize, focal)),
        StartsWith("3: K: expected focal lengths and a centre in pixels of an image of 320x240, got"));
}

TEST_F(CameraFileTest, WhatIsNoCameraIsNamed) {
  const std::string missing = folder_ / "none.yaml";
  EXPECT_EQ(support::ThrownReason([&] { Load(missing); }),
            missing + ": expected a camera (YAML, XML or JSON), got none");
  EXPECT_THAT(support::ThrownReason([&] { Load(folder_.path()); }), EndsWith("got a folder"));
  EXPECT_EQ(ReasonOf(""), " expected a camera as YAML, XML or JSON, got an empty file");
  EXPECT_EQ(ReasonOf("hello\n"), "1: expected \"key: value\", got \"hello\"");
  EXPECT_EQ(ReasonOf("%YAML:1.0\n---\nkey: [ 1, 2\n"),
            "3: key: expected a list or map with its end, got a part of it");
  EXPECT_EQ(ReasonOf("<root><camera>"), "1: expected </camera>, got the end of the file");
  EXPECT_EQ(ReasonOf("{\"K\": [1,"), " expected JSON of a camera, got none, or a part of it");
}

}  // namespace
}  // namespace priamos::head
