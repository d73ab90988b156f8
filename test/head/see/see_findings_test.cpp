#include "head/see/see_findings.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

constexpr double kFocal_px = 150, kBaseline_m = 0.12, kDepth_m = 2;

class SeeFindingsTest : public testing::Test {
 protected:
  /// A bright board 2 m before the cameras, as one sees it that stands so far to the right.
  std::string Photograph(const std::string& name, double right_m, cv::Size size = {160, 120},
                         double blur_px = 0.8) const {
    cv::Mat image(size, CV_8UC1, cv::Scalar(60));
    const int left = static_cast<int>(60 - std::lround(kFocal_px * right_m / kDepth_m));
    cv::rectangle(image, {left, 30}, {left + 50, 80}, cv::Scalar(180), cv::FILLED);
    cv::GaussianBlur(image, image, {}, blur_px);
    cv::imwrite(folder_ / name, image);
    return folder_ / name;
  }
  std::string Camera(const std::string& name, double right_m) const {
    std::ofstream(folder_ / name)
        << "%YAML:1.0\n---\nimage_width: 160\nimage_height: 120\nprojection_matrix:\n"
        << "   data: [ " << kFocal_px << ", 0., 80., " << -kFocal_px * right_m << ", 0., " << kFocal_px
        << ", 60., 0., 0., 0., 1., 0. ]\n";
    return folder_ / name;
  }
  SeeOptions Pair() const {
    return {.images = {Photograph("left.png", 0), Photograph("right.png", kBaseline_m)},
            .cameras = {Camera("left.yaml", 0), Camera("right.yaml", kBaseline_m)}};
  }
  std::string Board() const {
    std::ofstream(folder_ / "board.toml") << "[[points]]\nat_m = [0, 0, 0]\n[[points]]\nat_m = [1, 0, 0]\n"
                                          << "[[lines]]\npoints = [0, 1]\n";
    return folder_ / "board.toml";
  }
  static std::string ReasonOf(const SeeOptions& options) {
    return support::ThrownReason([&] { FindAll(options); });
  }

  TemporaryFolder folder_;
};

TEST_F(SeeFindingsTest, OnlyWhatIsAskedForIsLookedFor) {
  const SeeFindings dut = FindAll({.images = {Photograph("left.png", 0)}});
  ASSERT_EQ(dut.photographs.size(), 1u);
  EXPECT_EQ(dut.photographs[0].edges.segments.size(), 4u);
  EXPECT_EQ(dut.photographs[0].contours.corners().size(), 4u);
  EXPECT_TRUE(dut.cameras.empty());
  EXPECT_FALSE(dut.matches);
  EXPECT_FALSE(dut.doors);
  EXPECT_FALSE(dut.landmark);
}

TEST_F(SeeFindingsTest, ABlurredPhotographHasItsEdges) {
  for (const double blur_px : {3.0, 4.0}) {
    const SeeFindings dut = FindAll({.images = {Photograph("soft.png", 0, {160, 120}, blur_px)}});
    double length_px = 0;
    for (const EdgeSegment& segment : dut.photographs[0].edges.segments) length_px += segment.length_px();
    EXPECT_GT(length_px, 0.6 * 4 * 50) << blur_px;
    EXPECT_LT(length_px, 1.2 * 4 * 50) << blur_px;
  }
}

TEST_F(SeeFindingsTest, AViewBelongsToItsPhotographAndCamera) {
  const SeeFindings dut = FindAll(Pair());
  ASSERT_EQ(dut.views.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(dut.views[i].camera, &dut.cameras[i]);
    EXPECT_EQ(dut.views[i].edges, &dut.photographs[i].edges);
  }
  EXPECT_EQ(dut.cameras[1].image_from_base(0, 3), -kFocal_px * kBaseline_m);
}

TEST_F(SeeFindingsTest, ViewsStayWhereTheyAreWhenTheFindingsAreMoved) {
  SeeFindings found = FindAll(Pair());
  const SeeFindings dut = std::move(found);
  EXPECT_EQ(dut.views[1].camera, &dut.cameras[1]);
  EXPECT_EQ(dut.views[1].edges, &dut.photographs[1].edges);
}

TEST_F(SeeFindingsTest, APairHasItsUprightEdgesInSpace) {
  const SeeFindings dut = FindAll(Pair());
  ASSERT_TRUE(dut.matches);
  EXPECT_EQ(CountInSpace(*dut.matches), 2);
  for (const StereoMatch& match : *dut.matches) {
    if (match.space) {
      EXPECT_NEAR(match.space->from.z(), kDepth_m, 0.05);
    }
  }
}

TEST_F(SeeFindingsTest, OneOfThePairMayBeDarkerOrBrighter) {
  for (const double gain : {0.5, 0.7, 1.4}) {
    const SeeOptions options = Pair();
    const cv::Mat right = cv::imread(options.images[1], cv::IMREAD_GRAYSCALE);
    cv::imwrite(options.images[1], right * gain);
    const SeeFindings dut = FindAll(options);
    EXPECT_EQ(CountInSpace(*dut.matches), 2) << gain;
  }
}

TEST_F(SeeFindingsTest, ADarkImageOfAPairShowsTheEdgesOfTheOther) {
  const SeeOptions options = Pair();
  for (const std::string& file : options.images) {  // a faint mark on the board
    cv::Mat image = cv::imread(file, cv::IMREAD_GRAYSCALE);
    cv::Mat mark = image({90, 95, 30, 15});
    mark += cv::Scalar(14);
    cv::imwrite(file, image);
  }
  cv::imwrite(options.images[1], cv::imread(options.images[1], cv::IMREAD_GRAYSCALE) * 0.5);
  const SeeFindings dut = FindAll(options);
  EXPECT_GT(dut.photographs[0].edges.segments.size(), 4u);
  EXPECT_EQ(dut.photographs[1].edges.segments.size(), dut.photographs[0].edges.segments.size());
}

TEST_F(SeeFindingsTest, GreysAreThePhotographsInTheirOrder) {
  const SeeFindings dut = FindAll(Pair());
  const auto greys = dut.Greys();
  ASSERT_EQ(greys.size(), 2u);
  EXPECT_EQ(greys[0].data, dut.photographs[0].grey.data);
  EXPECT_EQ(greys[1].data, dut.photographs[1].grey.data);
}

TEST_F(SeeFindingsTest, ForALandmarkOneCameraIsEnough) {
  const SeeOptions options{.images = {Photograph("left.png", 0)},
                           .cameras = {Camera("left.yaml", 0)},
                           .landmark = Board(),
                           .at = {0, 0, 2, 0, 0, 0}};
  const SeeFindings dut = FindAll(options);
  ASSERT_TRUE(dut.landmark);
  EXPECT_EQ(dut.landmark->believed.translation(), Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(dut.landmark->body.points.size(), 2u);
  EXPECT_FALSE(dut.matches) << "one image has none";
}

TEST_F(SeeFindingsTest, ImagesAndCamerasMustBeAsMany) {
  SeeOptions options = Pair();
  options.cameras.pop_back();
  EXPECT_EQ(ReasonOf(options), "expected two or three images and a camera for each, got 2 and 1");
  options.images.pop_back();
  EXPECT_EQ(ReasonOf(options), "expected two or three images and a camera for each, got 1 and 1");
  options.landmark = Board();
  options.at = {0, 0, 0, 0, 0, 0};
  EXPECT_EQ(ReasonOf(options), "");
  options.cameras = std::vector<std::string>(4, options.cameras[0]);
  options.images = std::vector<std::string>(4, options.images[0]);
  EXPECT_EQ(ReasonOf(options), "expected one to three images and a camera for each, got 4 and 4");
}

TEST_F(SeeFindingsTest, ImagesOfOneSceneHaveOneSize) {
  SeeOptions options = Pair();
  options.images[1] = Photograph("large.png", 0, {161, 120});
  EXPECT_EQ(ReasonOf(options),
            options.images[1] + ": expected the size of " + options.images[0] + ", got 161x120");
  options.cameras.clear();
  EXPECT_EQ(ReasonOf(options), "") << "alone each may have its own";
}

TEST_F(SeeFindingsTest, AnImageOf32By32PixelsIsLargeEnough) {
  EXPECT_EQ(ReasonOf({.images = {Photograph("just.png", 0, {32, 32})}}), "");
  EXPECT_THAT(ReasonOf({.images = {Photograph("small.png", 0, {31, 40})}}),
              HasSubstr("small.png: expected an image of at least 32x32 pixels, got 31x40"));
  EXPECT_THAT(ReasonOf({.images = {folder_ / "none.png"}}), HasSubstr("none.png: expected an image"));
}

TEST_F(SeeFindingsTest, ExchangedImagesAreNamed) {
  SeeOptions options = Pair();
  std::swap(options.images[0], options.images[1]);
  EXPECT_EQ(ReasonOf(options),
            options.images[0] + " and " + options.images[1] +
                ": expected the images in the order of their cameras: 0 edges fit as they are, "
                "2 if the images are exchanged");
}

TEST_F(SeeFindingsTest, OneImageForTwoCamerasIsRefused) {
  SeeOptions options = Pair();
  options.images[1] = Photograph("copy.png", 0);
  EXPECT_EQ(ReasonOf(options), options.images[0] + " and " + options.images[1] +
                                   ": expected an image of each camera, got the same image twice");
  options.cameras.clear();
  EXPECT_EQ(ReasonOf(options), "") << "without cameras each is seen alone";
}

TEST_F(SeeFindingsTest, NearlyOneImageForTwoCamerasIsRefused) {
  SeeOptions options = Pair();
  const cv::Mat left = cv::imread(options.images[0], cv::IMREAD_GRAYSCALE);
  options.images[1] = folder_ / "again.jpg";
  cv::imwrite(options.images[1], left * 0.8);
  EXPECT_EQ(ReasonOf(options),
            options.images[0] + " and " + options.images[1] +
                ": expected an image of each camera, got nearly the same image twice: 2 of 2 "
                "edges that should have moved stand still");
}

TEST_F(SeeFindingsTest, ImagesOfDifferentScenesAreRefused) {
  SeeOptions options = Pair();
  cv::Mat other(120, 160, CV_8UC1, cv::Scalar(60));
  cv::circle(other, {110, 90}, 15, cv::Scalar(200), cv::FILLED);
  cv::line(other, {10, 110}, {150, 100}, cv::Scalar(180), 3);
  options.images[1] = folder_ / "other.png";
  cv::imwrite(options.images[1], other);
  EXPECT_THAT(ReasonOf(options), HasSubstr("none of which is in both"));
}

TEST_F(SeeFindingsTest, CamerasAtOnePlaceAreRefused) {
  SeeOptions options = Pair();
  options.cameras[1] = options.cameras[0];
  EXPECT_EQ(ReasonOf(options), options.cameras[0] + ", " + options.cameras[0] +
                                   ": expected cameras at different places, got two at one; say in "
                                   "projection_matrix where each stands");
}

TEST_F(SeeFindingsTest, TwelveBitsAreNotBlackAndItIsSaid) {
  const std::string file = Photograph("deep.png", 0);
  cv::Mat deep;
  cv::imread(file, cv::IMREAD_GRAYSCALE).convertTo(deep, CV_16U, 4095.0 / 255);
  cv::imwrite(file, deep);
  const SeeFindings dut = FindAll({.images = {file}});
  EXPECT_EQ(dut.photographs[0].edges.segments.size(), 4u);
  EXPECT_EQ(dut.note, file + ": 16 bits a pixel, of which 12 are in use: 4095 is taken for white");
}

TEST_F(SeeFindingsTest, DoorsNeedACamera) {
  SeeOptions options = Pair();
  options.cameras.clear();
  options.stand = {1.2};
  EXPECT_EQ(ReasonOf(options),
            "expected one or two images and their cameras to look for doors, got 0 cameras");
}

TEST_F(SeeFindingsTest, DoorsAreLookedForWhereTheCamerasStand) {
  SeeOptions options = Pair();
  options.stand = {1.2};
  const SeeFindings dut = FindAll(options);
  ASSERT_TRUE(dut.doors);
  ASSERT_EQ(dut.doors->views.size(), 2u);
  EXPECT_EQ(dut.doors->views[1].camera, &dut.doors->cameras[1]);
  EXPECT_NEAR(dut.doors->cameras[0].Depth({5, 0, 1.2}), 5, 1e-9) << "the base frame looks along x";
  EXPECT_TRUE(dut.doors->doors.empty()) << "a small board in the air is none";
}

TEST(CountInSpace, CountsWhatHasAPlace) {
  std::vector<StereoMatch> matches(4);
  EXPECT_EQ(CountInSpace(matches), 0);
  SpaceEdge edge;
  edge.from.setZero();
  edge.to.setZero();
  matches[1].space = edge;
  matches[3].space = edge;
  EXPECT_EQ(CountInSpace(matches), 2);
  EXPECT_EQ(CountInSpace({}), 0);
}

}  // namespace
}  // namespace priamos::head
