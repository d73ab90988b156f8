#include "head/see/see_drawing.hpp"

#include <gmock/gmock.h>

#include <opencv2/imgproc.hpp>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/drawn_shapes.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::LinesOn;
using testing::Contains;
using testing::ElementsAre;

constexpr int kWidth = 320, kHeight = 240;

EdgeSegment Segment(const Vector2d& begin, const Vector2d& end) {
  EdgeSegment s;
  s.begin = begin;
  s.end = end;
  return s;
}

const cv::Mat kGrey(kHeight, kWidth, CV_8UC1, cv::Scalar(90));

TEST(DrawContours, EdgesAreToldApartByTheirDirection) {
  EdgeImage edges;
  edges.segments = {Segment({50, 20}, {50, 200}), Segment({60, 200}, {62, 20}),  // upright, either way
                    Segment({20, 100}, {200, 101}),                              // level
                    Segment({20, 20}, {200, 120}), Segment({30, 20}, {60, 200})};
  const SeePage dut = DrawContours(kGrey, edges, {});
  EXPECT_EQ(LinesOn(dut.drawing(), "upright", kHeight).size(), 2u);
  EXPECT_EQ(LinesOn(dut.drawing(), "level", kHeight).size(), 1u);
  EXPECT_EQ(LinesOn(dut.drawing(), "sloping", kHeight).size(), 2u);
  EXPECT_THAT(support::MeaningsIn(dut.drawing()), ElementsAre("upright edge", "level edge", "other edge"));
}

TEST(DrawContours, ALineLiesWhereTheSegmentDoes) {
  EdgeImage edges;
  edges.segments = {Segment({50, 20}, {50, 200})};
  const auto lines = LinesOn(DrawContours(kGrey, edges, {}).drawing(), "upright", kHeight);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].points[0], Vector2d(50.5, 20.5));  // half a pixel from the corner of the page
  EXPECT_EQ(lines[0].points[1], Vector2d(50.5, 200.5));
}

TEST(DrawContours, ABoardIsAParallelogramWithFourCorners) {
  cv::Mat grey(kHeight, kWidth, CV_8UC1, cv::Scalar(60));
  cv::rectangle(grey, {120, 70}, {220, 150}, cv::Scalar(180), cv::FILLED);
  cv::GaussianBlur(grey, grey, {}, 0.8);
  EdgeImage edges;
  EdgeOperator().Extract(grey, edges);
  const SeePage dut = DrawContours(grey, edges, {edges, {}});
  const auto areas = LinesOn(dut.drawing(), "parallelogram", kHeight);
  ASSERT_EQ(areas.size(), 1u);
  EXPECT_TRUE(areas[0].closed);
  EXPECT_EQ(areas[0].points.size(), 4u);
  const auto corners = support::FormsOn<drawing::Circle>(dut.drawing(), "corner", kHeight);
  ASSERT_EQ(corners.size(), 4u);
  for (const auto& corner : corners) {
    EXPECT_NEAR(std::min(std::abs(corner.centre.x() - 120), std::abs(corner.centre.x() - 221)), 0, 0.3);
    EXPECT_NEAR(std::min(std::abs(corner.centre.y() - 70), std::abs(corner.centre.y() - 151)), 0, 0.3);
  }
}

/// Two or three views, each with two lines; segment i of view v begins at u = 100 v + 10 i.
class DrawMatchesTest : public testing::Test {
 protected:
  DrawMatchesTest() {
    camera_.image_from_base << 300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 1, 0;
    for (int v = 0; v < 3; ++v) {
      for (int i = 0; i < 2; ++i) {
        edges_[v].segments.push_back(Segment({10.0 * i + 5, 20}, {10.0 * i + 5, 100}));
        views_[v].lines.emplace_back().segment = 1 - i;  // the lines count backwards
      }
      views_[v].camera = &camera_;
      views_[v].edges = &edges_[v];
    }
  }
  static StereoMatch At(double depth_m, int line = 0) {
    StereoMatch match;
    match.left = line;
    match.right = {line};
    SpaceEdge edge;
    edge.from = {0, -0.5, depth_m - 0.1};
    edge.to = {0, 0.5, depth_m + 0.1};
    match.space = edge;
    return match;
  }
  SeePage Draw(const std::vector<StereoMatch>& matches, std::size_t views = 2) const {
    return DrawMatches(std::vector<cv::Mat>(views, kGrey), std::span(views_).first(views), matches);
  }

  CameraModel camera_;
  std::array<EdgeImage, 3> edges_;
  std::array<CameraView, 3> views_;
};

TEST_F(DrawMatchesTest, TheColourTellsTheDistance) {
  const std::vector<std::pair<double, const char*>> expected{
      {0.5, "to-1m"}, {1.2, "to-1.5m"}, {2, "to-2.5m"}, {3, "to-4m"}, {5, "to-8m"}, {20, "beyond-8m"}};
  for (const auto& [depth_m, layer] : expected) {
    const SeePage dut = Draw({At(depth_m)});
    EXPECT_EQ(LinesOn(dut.drawing(), layer, kHeight).size(), 2u) << depth_m;
    EXPECT_EQ(dut.drawing().LayersToExplain().size(), 2u) << "unmatched edges and this one, at " << depth_m;
  }
}

TEST_F(DrawMatchesTest, AMatchHasOneColourInAllImages) {
  StereoMatch match = At(3);
  match.right = {0, 1};  // broken there
  match.third = {1};
  const auto lines = LinesOn(Draw({match}, 3).drawing(), "to-4m", kHeight);
  std::vector<double> u;
  for (const auto& line : lines) u.push_back(line.points[0].x() - 0.5);
  EXPECT_THAT(u, ElementsAre(15, kWidth + 15, kWidth + 5, 2 * kWidth + 5));
}

TEST_F(DrawMatchesTest, WithoutADistanceAMatchIsWhite) {
  StereoMatch match = At(3);
  match.space.reset();
  EXPECT_EQ(LinesOn(Draw({match}).drawing(), "epipolar", kHeight).size(), 2u);
  EXPECT_THAT(support::MeaningsIn(Draw({match}).drawing()), Contains("matched, distance unknown"));
}

TEST_F(DrawMatchesTest, NearMatchesLieOnTop) {
  const SeePage dut = Draw({At(0.5, 0), At(20, 1), At(3, 1)});
  std::vector<std::string> order;
  for (const drawing::Shape& shape : dut.drawing().shapes())
    if (shape.layer->id != "unmatched" && (order.empty() || order.back() != shape.layer->id))
      order.emplace_back(shape.layer->id);
  ASSERT_GE(order.size(), 3u);
  order.resize(3);
  EXPECT_THAT(order, ElementsAre("beyond-8m", "to-4m", "to-1m"));
}

TEST_F(DrawMatchesTest, EveryEdgeIsThereEvenWithoutAMatch) {
  EXPECT_EQ(LinesOn(Draw({}).drawing(), "unmatched", kHeight).size(), 4u);
  EXPECT_EQ(LinesOn(Draw({}, 3).drawing(), "unmatched", kHeight).size(), 6u);
  EXPECT_EQ(Draw({}, 3).drawing().width(), 3 * kWidth);
}

}  // namespace
}  // namespace priamos::head
