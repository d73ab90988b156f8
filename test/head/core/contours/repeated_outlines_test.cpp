#include "head/core/contours/repeated_outlines.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "head/core/contours/contour_graph.hpp"
#include "head/core/edges/edge_segments.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;

/// Outlines with corners of their own.
struct Outlines {
  void Add(const std::vector<Vector2d>& outline, double extension_px = 1) {
    Polygon& polygon = polygons.emplace_back();
    for (const Vector2d& at : outline) {
      polygon.sides.push_back(static_cast<int>(polygons.size()));
      polygon.corners.push_back(static_cast<int>(corners.size()));
      corners.push_back({.at = at,
                         .covariance = Eigen::Matrix2d::Identity(),
                         .segments = {},
                         .ends = {},
                         .extension_px = {extension_px, -extension_px}});
    }
  }
  void AddSquare(double u, double v, double side, double extension_px = 1) {
    Add({{u, v}, {u + side, v}, {u + side, v + side}, {u, v + side}}, extension_px);
  }
  std::vector<Polygon> Dut() const { return WithoutRepeated(polygons, corners); }

  std::vector<Polygon> polygons;
  std::vector<Corner> corners;
};

TEST(WithoutRepeatedTest, OfOnePlaceTheLeastChangedIsKept) {
  Outlines outlines;
  outlines.AddSquare(100, 100, 80, 5);
  outlines.AddSquare(103, 98, 82, 2);
  outlines.AddSquare(99, 101, 79, 3);
  const auto dut = outlines.Dut();
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0].corners, outlines.polygons[1].corners);
}

TEST(WithoutRepeatedTest, WhereTheyBeginDoesNotMatter) {
  Outlines outlines;
  outlines.Add({{100, 100}, {180, 100}, {180, 180}, {100, 180}});
  outlines.Add({{181, 181}, {101, 181}, {101, 101}, {181, 101}});
  EXPECT_EQ(outlines.Dut().size(), 1u);
}

TEST(WithoutRepeatedTest, FramesWithinFramesAndNeighboursStay) {
  Outlines outlines;
  outlines.AddSquare(100, 100, 80);
  outlines.AddSquare(112, 112, 56);
  outlines.AddSquare(190, 100, 80);
  outlines.Add({{100, 100}, {180, 100}, {140, 180}});
  EXPECT_EQ(outlines.Dut().size(), 4u);
}

TEST(WithoutRepeatedTest, SmallOutlinesAreOneOnlyIfTheyLieNearer) {
  Outlines outlines;
  outlines.AddSquare(100, 100, 20);
  outlines.AddSquare(105, 100, 20);
  EXPECT_EQ(outlines.Dut().size(), 2u);
}

TEST(WithoutRepeatedTest, NothingStaysNothing) {
  EXPECT_TRUE(WithoutRepeated({}, {}).empty());
}

TEST(WithoutRepeatedTest, ADrawnBorderIsOneParallelogram) {
  cv::Mat grey(240, 320, CV_8UC1, cv::Scalar(180));
  for (const int inset : {0, 40})
    cv::rectangle(grey, {60 + inset, 40 + inset}, {260 - inset, 200 - inset}, cv::Scalar(60), 5);
  cv::GaussianBlur(grey, grey, {}, 0.8);
  EdgeImage edges;
  EdgeOperator().Extract(grey, edges);
  EXPECT_GE(edges.segments.size(), 16u) << "two lines have four borders of four sides";
  int n = 0;
  for (const Polygon& polygon : ContourGraph(edges, {}).polygons()) n += polygon.is_parallelogram;
  EXPECT_EQ(n, 2);
}

}  // namespace
}  // namespace priamos::head
