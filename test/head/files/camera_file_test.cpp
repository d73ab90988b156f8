#include "head/files/projection_file.hpp"

#include <gmock/gmock.h>

#include <fstream>

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

class ProjectionFileTest : public testing::Test {
 protected:
  std::string Write(const std::string& text) const {
    std::ofstream(file_) << "%YAML:1.0\n---\n" << text;
    return file_;
  }
  /// Why the file with this text is refused for an image of 320 by 240 pixels, without its name.
  std::string ReasonOf(const std::string& text) const {
    Write(text);
    const std::string reason = support::ThrownReason([&] { LoadProjection(file_, 320, 240); });
    EXPECT_THAT(reason, StartsWith(file_ + ": "));
    return reason.size() > file_.size() ? reason.substr(file_.size() + 2) : "";
  }
  static std::string Matrix(const std::string& numbers) {
    return "projection_matrix:\n   rows: 3\n   cols: 4\n   data: [ " + numbers + " ]\n";
  }

  TemporaryFolder folder_;
  const std::string file_ = folder_ / "left.yaml";
};

TEST_F(ProjectionFileTest, ReadsTheMatrixRowByRow) {
  const CameraModel dut = LoadProjection(Write(std::string(kSize) + kMatrix), 320, 240);
  Eigen::Matrix<double, 3, 4> expected;
  expected << 300, 0, 160.5, -36, 0, 310, 120.25, 2, 0, 0, 1, 0.5;
  EXPECT_EQ(dut.image_from_base, expected);
}

TEST_F(ProjectionFileTest, ARectifiedPhotographHasNoDistortionAboutItsMiddle) {
  const CameraModel dut = LoadProjection(Write(std::string(kSize) + kMatrix), 320, 240);
  EXPECT_EQ(dut.centre_px, Eigen::Vector2d(159.5, 119.5));
  EXPECT_EQ(dut.k1, 0);
  EXPECT_EQ(dut.k2, 0);
  EXPECT_EQ(dut.Distort({10, 20}), Eigen::Vector2d(10, 20));
}

TEST_F(ProjectionFileTest, DistortionMustBeZero) {
  const auto with = [](const std::string& numbers) {
    return std::string(kSize) + kMatrix + "distortion_coefficients:\n   data: [ " + numbers + " ]\n";
  };
  EXPECT_NO_THROW(LoadProjection(Write(with("0., 0., 0, 0., 0.")), 320, 240));
  EXPECT_EQ(ReasonOf(with("0., 0., 0., 0., 1e-3")),
            "distortion_coefficients: expected zeros (rectified photographs), got others");
}

TEST_F(ProjectionFileTest, DistortionThatSaysNothingIsNotTakenForNone) {
  for (const char* value : {" 0.1\n", " [ 0.1, 0. ]\n", "\n   rows: 1\n"})
    EXPECT_EQ(ReasonOf(std::string(kSize) + kMatrix + "distortion_coefficients:" + value),
              "distortion_coefficients: expected data with numbers, got none")
        << value;
}

TEST_F(ProjectionFileTest, ACameraOfAnotherImageIsRefusedWithBothSizes) {
  EXPECT_EQ(ReasonOf(std::string("image_width: 640\nimage_height: 480\n") + kMatrix),
            "image_width, image_height: expected the image's 320x240, got 640x480");
  EXPECT_THAT(ReasonOf(std::string("image_width: 320\nimage_height: 241\n") + kMatrix), EndsWith("320x241"));
}

TEST_F(ProjectionFileTest, WithoutAWholeSizeItIsRefused) {
  for (const char* size : {"", "image_width: 320\n", "image_width: 320.5\nimage_height: 240\n",
                           "image_width: wide\nimage_height: 240\n"})
    EXPECT_EQ(ReasonOf(std::string(size) + kMatrix), "image_width, image_height: expected integers, got none")
        << size;
}

TEST_F(ProjectionFileTest, TheMatrixNeedsTwelveNumbers) {
  EXPECT_EQ(ReasonOf(kSize), "projection_matrix: expected data with 12 numbers, got 0");
  EXPECT_EQ(ReasonOf(kSize + Matrix("1, 2, 3")), "projection_matrix: expected data with 12 numbers, got 3");
  EXPECT_EQ(ReasonOf(std::string(kSize) + "projection_matrix: 5\n"),
            "projection_matrix: expected data with 12 numbers, got 0");
  EXPECT_EQ(ReasonOf(std::string(kSize) + "projection_matrix: [ 1, 2 ]\n"),
            "projection_matrix: expected data with 12 numbers, got 0");
  EXPECT_EQ(ReasonOf(kSize + Matrix("300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 1, one")),
            "projection_matrix: expected numbers, got something else");
  EXPECT_EQ(ReasonOf(kSize + Matrix("300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 1, .Inf")),
            "projection_matrix: expected numbers, got something else");
}

TEST_F(ProjectionFileTest, ASingularMatrixIsNoCamera) {
  EXPECT_EQ(ReasonOf(kSize + Matrix("300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 0, 1")),
            "projection_matrix: expected a camera, got a singular matrix");
}

TEST_F(ProjectionFileTest, WhatIsNoYamlIsNamed) {
  const std::string expected = ": expected a camera as YAML (first line %YAML:1.0), got none";
  const std::string missing = folder_ / "none.yaml";
  testing::internal::CaptureStderr();
  EXPECT_EQ(support::ThrownReason([&] { LoadProjection(missing, 320, 240); }), missing + expected);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "OpenCV has nothing to say";
  for (const char* text : {"", "hello\n", "%YAML:1.0\n---\nkey: [ 1, 2\n", "%YAML:1.0\n---\n- 1\n- 2\n"}) {
    std::ofstream(file_) << text;
    EXPECT_EQ(support::ThrownReason([&] { LoadProjection(file_, 320, 240); }), file_ + expected) << text;
  }
}

}  // namespace
}  // namespace priamos::head
