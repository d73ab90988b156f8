#include "head/images/decoded_image.hpp"

#include <gmock/gmock.h>

#include "test/head/images/encoded_images.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

TEST(CheckImageSize, RefusesNothingAndTooMuch) {
  EXPECT_FALSE(CheckImageSize(1, 1, {}));
  EXPECT_FALSE(CheckImageSize(10000, 10000, {}));
  EXPECT_EQ(CheckImageSize(10000, 10001, {})->reason,
            "expected at most 100 megapixels, got 10000x10001; make it smaller");
  EXPECT_THAT(CheckImageSize(1LL << 62, 1LL << 62, {})->reason, HasSubstr("100 megapixels"));
  for (const auto& [width, height] : {std::pair(0, 5), std::pair(5, 0), std::pair(-1, -1)})
    EXPECT_THAT(CheckImageSize(width, height, {})->reason, HasSubstr("with pixels"));
}

TEST(GreyOfSamples, WeighsColoursAsEyesDo) {
  const cv::Mat green(4, 4, CV_16UC3, cv::Scalar(0, 60000, 0));
  EXPECT_NEAR(GreyOfSamples(green)->at<std::uint16_t>(2, 2), 0.587 * 60000, 10);
}

TEST(GreyOfSamples, OpacityIsDroppedWhereAllIsOpaqueAndRefusedElsewhere) {
  for (const int type : {CV_8UC2, CV_8UC4, CV_16UC2, CV_16UC4}) {
    cv::Mat samples(10, 10, type, cv::Scalar::all(CV_MAT_DEPTH(type) == CV_8U ? 255 : 65535));
    ASSERT_TRUE(GreyOfSamples(samples)) << type;
    EXPECT_EQ(GreyOfSamples(samples)->channels(), 1);
    samples.row(3).setTo(cv::Scalar::all(254));
    EXPECT_THAT(GreyOfSamples(samples).reason(), HasSubstr("expected an opaque image, got 10 % transparent"));
  }
}

TEST(TurnUpright, EveryOrientationPutsTheCornersWhereTheyBelong) {
  // The letter F of EXIF's own picture: the corner that each orientation stores first.
  const cv::Mat upright = (cv::Mat_<std::uint8_t>(2, 3) << 1, 2, 3, 4, 5, 6);
  const std::vector<cv::Mat> stored{
      (cv::Mat_<std::uint8_t>(2, 3) << 1, 2, 3, 4, 5, 6), (cv::Mat_<std::uint8_t>(2, 3) << 3, 2, 1, 6, 5, 4),
      (cv::Mat_<std::uint8_t>(2, 3) << 6, 5, 4, 3, 2, 1), (cv::Mat_<std::uint8_t>(2, 3) << 4, 5, 6, 1, 2, 3),
      (cv::Mat_<std::uint8_t>(3, 2) << 1, 4, 2, 5, 3, 6), (cv::Mat_<std::uint8_t>(3, 2) << 3, 6, 2, 5, 1, 4),
      (cv::Mat_<std::uint8_t>(3, 2) << 6, 3, 5, 2, 4, 1), (cv::Mat_<std::uint8_t>(3, 2) << 4, 1, 5, 2, 6, 3)};
  for (int orientation = 1; orientation <= 8; ++orientation)
    EXPECT_EQ(Difference(TurnUpright(stored[orientation - 1], orientation), upright), 0) << orientation;
  EXPECT_EQ(Difference(TurnUpright(upright, 0), upright), 0);
  EXPECT_EQ(Difference(TurnUpright(upright, 9), upright), 0);
}

}  // namespace
}  // namespace priamos::head
