#include "head/see/see_text.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

SeenPhotograph Photograph(const cv::Mat& grey) {
  SeenPhotograph photograph{"photo.png", grey, {}, {}, {}};
  EdgeOperator().Extract(grey, photograph.edges);
  photograph.contours = {photograph.edges, {}};
  return photograph;
}

TEST(SeeTextTest, CountsTheEdgesOfABoard) {
  cv::Mat grey(240, 320, CV_8UC1, cv::Scalar(60));
  cv::rectangle(grey, {120, 70}, {220, 150}, cv::Scalar(180), cv::FILLED);
  cv::GaussianBlur(grey, grey, {}, 0.8);
  EXPECT_EQ(EdgesText(Photograph(grey), "photo-edges.png"),
            "photo.png: 4 segments, 4 corners, 1 parallelograms, drawn in photo-edges.png\n");
}

TEST(SeeTextTest, AnImageWithoutContentIsNamedWithTheReason) {
  EXPECT_EQ(EdgesText(Photograph(cv::Mat(240, 320, CV_8UC1, cv::Scalar(0))), "e.png"),
            "photo.png: 0 segments, 0 corners, 0 parallelograms, drawn in e.png\n"
            "photo.png: nothing can be seen: black\n");
}

TEST(SeeTextTest, MatchesAlongEpipolarLinesHaveNoPlaceInSpace) {
  std::vector<StereoMatch> matches(3);
  SpaceEdge somewhere;
  somewhere.from.setZero();
  somewhere.to.setZero();
  matches[1].space = somewhere;
  EXPECT_EQ(MatchesText(matches, "s.png"),
            "together: 3 matches, 1 of them with a place in space, drawn in s.png\n");
  EXPECT_EQ(MatchesText({}, "s.png"),
            "together: 0 matches, 0 of them with a place in space, drawn in s.png\n");
}

TEST(SeeTextTest, DoorsAreNumberedFromOne) {
  DetectedDoor door;
  door.base_from_door = {3, -0.25, Radians(10)};
  door.covariance << 0.0009, 0, 0, 0.0016;
  door.width_m = 0.9;
  door.height_m = 2.05;
  EXPECT_EQ(
      DoorsText(std::vector{door, door}, "d.png"),
      "doors: 2, drawn in d.png\n"
      "  door 1: 3.00 m ahead, -0.25 m to the left, 10.0 deg; 0.90 m wide, 2.05 m high, sigma 0.05 m\n"
      "  door 2: 3.00 m ahead, -0.25 m to the left, 10.0 deg; 0.90 m wide, 2.05 m high, sigma 0.05 m\n");
  EXPECT_EQ(DoorsText({}, "d.png"), "doors: 0, drawn in d.png\n");
}

TEST(SeeTextTest, ALandmarkHasItsPoseOrTheReasonWhyNot) {
  FreeModelFix fix;
  fix.verdict = Verdict::kTooFewEdges;
  EXPECT_EQ(LandmarkText("body.cao", fix, "l.png"),
            std::string("body.cao: not found: ") + Describe(Verdict::kTooFewEdges) + "; drawn in l.png\n");
  fix.verdict = Verdict::kFound;
  fix.base_from_model =
      Eigen::Translation3d(0.1, -0.2, 1.5) * Eigen::AngleAxisd(Radians(30), Eigen::Vector3d::UnitZ());
  fix.n_matched = 7;
  fix.residual_px = 0.256;
  EXPECT_EQ(LandmarkText("body.cao", fix, "l.png"),
            "body.cao: at 0.1000 -0.2000 1.5000 m, 0.000 -0.000 30.000 deg; 7 edges, 0.26 px, drawn in "
            "l.png\n");
}

}  // namespace
}  // namespace priamos::head
