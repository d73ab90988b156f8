#include "head/core/contours/contour_graph.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "test/support/line_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;

/// Segments as an operator would give them.
class Drawing {
 public:
  Drawing() { image_.width = 768, image_.height = 576; }
  Drawing& Line(const Vector2d& begin, const Vector2d& end) {
    EdgeSegment s;
    s.begin = begin;
    s.end = end;
    s.centre = (begin + end) / 2;
    s.sigma_normal_px = 0.02;
    s.sigma_angle_rad = 0.07 / s.length_px();
    s.grey_left = 80;
    s.grey_right = 140;
    image_.segments.push_back(s);
    return *this;
  }
  /// A closed outline whose sides stop `gap` px before the corners.
  Drawing& Outline(const std::vector<Vector2d>& corners, double gap) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const Vector2d d = (b - a).normalized();
      Line(a + gap * d, b - gap * d);
    }
    return *this;
  }
  ContourGraph Graph() const { return ContourGraph(image_, {}); }

  EdgeImage image_;
};

const Relation* Between(const ContourGraph& graph, int a, int b) {
  for (const Relation& r : graph.relations()) {
    if (r.a == std::min(a, b) && r.b == std::max(a, b)) return &r;
  }
  return nullptr;
}

TEST(ContourGraphTest, ParallelEdges) {
  const auto dut = Drawing().Line({100, 100}, {200, 110}).Line({200, 130}, {100, 120}).Graph();
  const Relation* r = Between(dut, 0, 1);
  ASSERT_TRUE(r);
  EXPECT_TRUE(r->parallel);
  EXPECT_FALSE(r->same_sign || r->perpendicular || r->collinear || r->intersecting);
  EXPECT_NEAR(r->distance_px, 20 * std::cos(std::atan(0.1)), 1e-6);
  EXPECT_TRUE(dut.polygons().empty());
}

TEST(ContourGraphTest, PerpendicularEdgesThatMeet) {
  const auto dut = Drawing().Line({100, 100}, {196, 100}).Line({200, 104}, {200, 200}).Graph();
  const Relation* r = Between(dut, 0, 1);
  ASSERT_TRUE(r);
  EXPECT_TRUE(r->perpendicular && r->intersecting);
  EXPECT_NEAR(r->angle_rad, kPi / 2, 1e-6);
  ASSERT_EQ(dut.corners().size(), 1u);
  EXPECT_LT((dut.corners()[0].at - Vector2d(200, 100)).norm(), 1e-9);
  EXPECT_NEAR(dut.corners()[0].extension_px[0], 4, 1e-9);
  EXPECT_EQ(dut.corners()[0].segments, (std::array{0, 1}));
  EXPECT_EQ(dut.corners()[0].ends, (std::array{1, 0}));
}

TEST(ContourGraphTest, CollinearEdges) {
  const auto dut = Drawing().Line({100, 100}, {150, 105}).Line({170, 107}, {300, 120}).Graph();
  const Relation* r = Between(dut, 0, 1);
  ASSERT_TRUE(r);
  EXPECT_TRUE(r->collinear && r->same_sign);
  EXPECT_FALSE(r->parallel);
}

TEST(ContourGraphTest, CrossingEdgesIntersectButHaveNoCorner) {
  const auto dut = Drawing().Line({100, 100}, {300, 120}).Line({190, 50}, {210, 200}).Graph();
  const Relation* r = Between(dut, 0, 1);
  ASSERT_TRUE(r);
  EXPECT_TRUE(r->intersecting);
  EXPECT_TRUE(dut.corners().empty());
}

TEST(ContourGraphTest, FarEdgesHaveNoRelation) {
  EXPECT_TRUE(
      Drawing().Line({100, 100}, {200, 100}).Line({100, 200}, {200, 200}).Graph().relations().empty());
}

TEST(ContourGraphTest, WhetherEdgesAreParallelDependsOnHowWellTheyAreKnown) {
  Drawing drawing;
  drawing.Line({100, 100}, {160, 100}).Line({100, 120}, {160, 124});  // 0.067 rad
  EXPECT_FALSE(Between(drawing.Graph(), 0, 1));
  drawing.image_.segments[1].sigma_angle_rad = 0.02;
  ASSERT_TRUE(Between(drawing.Graph(), 0, 1));
  EXPECT_TRUE(Between(drawing.Graph(), 0, 1)->parallel);
}

TEST(ContourGraphTest, AParallelogramWithLostCorners) {
  const std::vector<Vector2d> corners{{100, 100}, {220, 110}, {250, 210}, {130, 200}};
  const auto dut = Drawing().Outline(corners, 6).Graph();
  ASSERT_EQ(dut.polygons().size(), 1u);
  EXPECT_TRUE(dut.polygons()[0].is_parallelogram);
  const auto outline = dut.Outline(dut.polygons()[0]);
  ASSERT_EQ(outline.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_LT((outline[i] - corners[i]).norm(), 1e-6);
    EXPECT_EQ(dut.polygons()[0].sides[i], i);
  }
}

TEST(ContourGraphTest, TheDirectionOfTheSidesDoesNotMatter) {
  std::vector<Vector2d> corners{{100, 100}, {220, 110}, {250, 210}, {130, 200}};
  Drawing drawing;
  drawing.Outline(corners, 6);
  std::swap(drawing.image_.segments[1].begin, drawing.image_.segments[1].end);
  std::swap(drawing.image_.segments[2].begin, drawing.image_.segments[2].end);
  EXPECT_EQ(drawing.Graph().polygons().size(), 1u);
}

TEST(ContourGraphTest, ATrapezoidIsNoParallelogram) {
  const auto dut = Drawing().Outline({{100, 100}, {200, 100}, {250, 200}, {50, 200}}, 4).Graph();
  ASSERT_EQ(dut.polygons().size(), 1u);
  EXPECT_FALSE(dut.polygons()[0].is_parallelogram);
}

TEST(ContourGraphTest, AConcaveOutlineIsNoPolygon) {
  const auto dut = Drawing().Outline({{100, 100}, {300, 100}, {300, 300}, {200, 150}, {100, 300}}, 3).Graph();
  EXPECT_TRUE(dut.polygons().empty());
}

TEST(ContourGraphTest, ABoxHasThreeFaces) {
  // A cube seen from a corner: three parallelograms share three sides.
  Drawing cube;
  const Vector2d o(300, 300), x(90, 40), y(-90, 40), z(0, -110);
  const auto side = [&](Vector2d a, Vector2d b) {
    const Vector2d d = (b - a).normalized();
    cube.Line(a + 4 * d, b - 4 * d);
  };
  side(o, o + x);
  side(o, o + y);
  side(o, o + z);
  side(o + x, o + x + z);
  side(o + y, o + y + z);
  side(o + x, o + x + y);
  side(o + y, o + x + y);
  side(o + z, o + z + x);
  side(o + z, o + z + y);
  const auto dut = cube.Graph();
  int n_parallelograms = 0;
  for (const Polygon& p : dut.polygons()) n_parallelograms += p.is_parallelogram;
  EXPECT_EQ(n_parallelograms, 3);
  const auto has_first_side = [](const Polygon& p) {
    return std::find(p.sides.begin(), p.sides.end(), 0) != p.sides.end();
  };
  EXPECT_EQ(std::count_if(dut.polygons().begin(), dut.polygons().end(), has_first_side), 2)
      << "side o, o + x belongs to two faces";
}

TEST(ContourGraphTest, TriangleAndHexagon) {
  EXPECT_EQ(Drawing().Outline({{100, 100}, {200, 120}, {140, 200}}, 5).Graph().polygons().size(), 1u);
  std::vector<Vector2d> hexagon;
  for (int i = 0; i < 6; ++i)
    hexagon.push_back({300 + 90 * std::cos(i * kPi / 3), 300 + 90 * std::sin(i * kPi / 3)});
  EXPECT_EQ(Drawing().Outline(hexagon, 5).Graph().polygons().size(), 1u);
}

TEST(ContourGraphTest, FindsTheRectanglesOfAPictureWithCredibleCorners) {
  Rng rng(4);
  EdgeOperator op;
  EdgeImage edges;
  int n_rectangles = 0, n_corners = 0;
  double nees = 0;
  constexpr int kScenes = 4;
  for (int i = 0; i < kScenes; ++i) {
    const auto scene = test::RandomRectangles(80, 4, 0.5, rng);
    op.Extract(scene.image, edges);
    const ContourGraph dut(edges, {});
    for (const Polygon& p : dut.polygons()) n_rectangles += p.is_parallelogram;
    for (const Corner& corner : dut.corners()) {
      for (const auto& line : scene.lines) {
        const Vector2d error = corner.at - line.begin;
        if (error.norm() > 1) continue;
        ++n_corners;
        nees += error.dot(corner.covariance.inverse() * error) / 2;
      }
    }
  }
  EXPECT_GE(n_rectangles, 12 * kScenes - 1);
  EXPECT_LE(n_rectangles, 12 * kScenes);
  EXPECT_GE(n_corners, 48 * kScenes - 3);
  EXPECT_NEAR(nees / n_corners, 1, 0.4);
}

TEST(ContourGraphTest, TheOrderOfTheSegmentsDoesNotMatter) {
  Rng rng(5);
  Drawing drawing;
  for (int i = 0; i < 300; ++i) {
    const Vector2d begin(rng.Uniform(0, 768), rng.Uniform(0, 576));
    const double angle = rng.Chance(0.5) ? kPi / 2 * rng.Below(4) : rng.Uniform(0, 2 * kPi);
    drawing.Line(begin, begin + rng.Uniform(15, 60) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  const ContourGraph first = drawing.Graph();
  std::mt19937 shuffle(1);
  std::shuffle(drawing.image_.segments.begin(), drawing.image_.segments.end(), shuffle);
  const ContourGraph second = drawing.Graph();
  EXPECT_GT(first.relations().size(), 100u);
  EXPECT_EQ(first.relations().size(), second.relations().size());
  EXPECT_EQ(first.corners().size(), second.corners().size());
  EXPECT_EQ(first.polygons().size(), second.polygons().size());
}

TEST(ContourGraphTest, NoEdgesNoContours) {
  EdgeImage empty;
  const ContourGraph dut(empty, {});
  EXPECT_TRUE(dut.relations().empty() && dut.corners().empty() && dut.polygons().empty());
}

}  // namespace
}  // namespace priamos::head
