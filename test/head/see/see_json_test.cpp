#include "head/see/see_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "head/core/edges/edge_segments.hpp"

namespace priamos::head {
namespace {

using nlohmann::ordered_json;

EdgeSegment Segment(double u1, double v1, double u2, double v2) {
  EdgeSegment s;
  s.begin = {u1, v1};
  s.end = {u2, v2};
  s.sigma_normal_px = 0.02;
  s.sigma_angle_rad = 0.001;
  s.grey_left = 60;
  s.grey_right = 180;
  return s;
}

TEST(EdgesToJson, SegmentsKeepTheirEndsSigmasAndGreyValues) {
  EdgeImage edges;
  edges.width = 320;
  edges.height = 240;
  edges.segments = {Segment(10.25, 20.5, 30, 40), Segment(1, 2, 3, 4)};
  const ordered_json dut = EdgesToJson("hall.png", edges, {});
  EXPECT_EQ(dut["image"], "hall.png");
  EXPECT_EQ(dut["width_px"], 320);
  EXPECT_EQ(dut["height_px"], 240);
  ASSERT_EQ(dut["segments"].size(), 2u);
  EXPECT_EQ(dut["segments"][0]["begin_px"].dump(), "[10.25,20.5]");
  EXPECT_EQ(dut["segments"][0]["end_px"].dump(), "[30.0,40.0]");
  EXPECT_EQ(dut["segments"][0]["sigma_normal_px"], 0.02);
  EXPECT_EQ(dut["segments"][0]["sigma_angle_rad"], 0.001);
  EXPECT_EQ(dut["segments"][0]["grey_left"], 60);
  EXPECT_EQ(dut["segments"][0]["grey_right"], 180);
  EXPECT_EQ(dut["segments"][1]["begin_px"].dump(), "[1.0,2.0]");
}

TEST(EdgesToJson, WhatIsNotThereIsAnEmptyList) {
  const ordered_json dut = EdgesToJson("black.png", {}, {});
  for (const char* list : {"segments", "corners", "outlines"}) EXPECT_EQ(dut[list].dump(), "[]") << list;
}

TEST(EdgesToJson, NumbersInCornersAndOutlinesLeadToSegmentsAndCorners) {
  cv::Mat grey(240, 320, CV_8UC1, cv::Scalar(60));
  cv::rectangle(grey, {120, 70}, {220, 150}, cv::Scalar(180), cv::FILLED);
  cv::GaussianBlur(grey, grey, {}, 0.8);
  EdgeImage edges;
  EdgeOperator().Extract(grey, edges);
  const ordered_json dut = EdgesToJson("board.png", edges, {edges, {}});
  ASSERT_EQ(dut["corners"].size(), 4u);
  for (const auto& corner : dut["corners"]) {
    const double u = corner["at_px"][0], v = corner["at_px"][1];
    EXPECT_NEAR(std::min(std::abs(u - 119.5), std::abs(u - 220.5)), 0, 0.3);
    EXPECT_NEAR(std::min(std::abs(v - 69.5), std::abs(v - 150.5)), 0, 0.3);
    ASSERT_EQ(corner["covariance_px2"].size(), 2u);
    for (int k = 0; k < 2; ++k) {
      EXPECT_GT(corner["covariance_px2"][k][k], 0);
      EXPECT_LT(corner["covariance_px2"][k][k], 0.01);
    }
    EXPECT_EQ(corner["covariance_px2"][0][1], corner["covariance_px2"][1][0]);
    for (const std::size_t segment : corner["segments"]) EXPECT_LT(segment, dut["segments"].size());
  }
  ASSERT_EQ(dut["outlines"].size(), 1u);
  EXPECT_EQ(dut["outlines"][0]["segments"].size(), 4u);
  EXPECT_EQ(dut["outlines"][0]["corners"].size(), 4u);
  EXPECT_EQ(dut["outlines"][0]["parallelogram"], true);
}

class MatchesToJsonTest : public testing::Test {
 protected:
  MatchesToJsonTest() {
    for (int v = 0; v < 3; ++v)
      for (int i = 0; i < 3; ++i) views_[v].lines.emplace_back().segment = 10 * (v + 1) + i;
    match_.left = 1;
    match_.right = {2, 0};
    match_.epipolar_rad = 0.5;
    match_.similarity = 0.75;
  }
  ordered_json Dut(std::size_t views) const {
    return MatchesToJson(std::span(views_).first(views), std::span(&match_, 1))[0];
  }

  std::array<CameraView, 3> views_;
  StereoMatch match_;
};

TEST_F(MatchesToJsonTest, LinesAreNamedByTheirSegments) {
  EXPECT_EQ(Dut(2)["segments"].dump(), "[[11],[22,20]]");
  EXPECT_EQ(Dut(2)["epipolar_rad"], 0.5);
  EXPECT_EQ(Dut(2)["similarity"], 0.75);
}

TEST_F(MatchesToJsonTest, AThirdImageAddsItsSegments) {
  match_.third = {1};
  EXPECT_EQ(Dut(3)["segments"].dump(), "[[11],[22,20],[31]]");
  match_.third.clear();
  EXPECT_EQ(Dut(3)["segments"].dump(), "[[11],[22,20],[]]");
}

TEST_F(MatchesToJsonTest, WithoutAPlaceInSpaceNoneIsTold) {
  for (const char* key : {"from_m", "to_m", "sigma_from_m", "sigma_to_m"})
    EXPECT_FALSE(Dut(2).contains(key)) << key;
}

TEST_F(MatchesToJsonTest, AnEdgeOfSpaceHasItsEndsAndTheirSigmas) {
  SpaceEdge edge;
  edge.from = {1, 2, 3};
  edge.to = {4, 5, 6};
  edge.covariance.diagonal() << 1, 4, 9, 16, 25, -1e-18;
  match_.space = edge;
  const ordered_json dut = Dut(2);
  EXPECT_EQ(dut["from_m"].dump(), "[1.0,2.0,3.0]");
  EXPECT_EQ(dut["to_m"].dump(), "[4.0,5.0,6.0]");
  EXPECT_EQ(dut["sigma_from_m"].dump(), "[1.0,2.0,3.0]");
  EXPECT_EQ(dut["sigma_to_m"].dump(), "[4.0,5.0,0.0]");
}

TEST(MatchesToJson, NoMatchesAreAnEmptyList) {
  EXPECT_EQ(MatchesToJson({}, {}).dump(), "[]");
}

}  // namespace
}  // namespace priamos::head
