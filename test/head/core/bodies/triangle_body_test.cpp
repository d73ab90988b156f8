#include "head/core/bodies/triangle_body.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace priamos::head {
namespace {

using testing::HasSubstr;

/// A square of two triangles, counter-clockwise seen from where a, b, c, d turn to the left.
void AddSquare(TriangleMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  const int n = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {a, b, c, d});
  mesh.triangles.push_back({n, n + 1, n + 2});
  mesh.triangles.push_back({n, n + 2, n + 3});
}

/// Every triangle of an STL file has points of its own.
TriangleMesh Cube() {
  TriangleMesh mesh;
  const auto p = [](double x, double y, double z) { return Eigen::Vector3d(x, y, z); };
  AddSquare(mesh, p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0));
  AddSquare(mesh, p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
  AddSquare(mesh, p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
  AddSquare(mesh, p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0));
  AddSquare(mesh, p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  AddSquare(mesh, p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1));
  return mesh;
}

double LengthSeen(const Polyhedron& body, const Eigen::Vector3d& eye) {
  double sum = 0;
  for (const LandmarkEdge& e : VisibleSkeleton(body, eye).edges) sum += (e.to - e.from).norm();
  return sum;
}

TEST(TriangleBody, TwelveTrianglesAreSixFacesAndEightPoints) {
  const auto dut = BodyOfTriangles(Cube());
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->faces.size(), 6u);
  for (const auto& face : dut->faces) EXPECT_EQ(face.size(), 4u);
  EXPECT_EQ(VisibleSkeleton(*dut, {5, 6, 7}).edges.size(), 9u);
}

TEST(TriangleBody, PointsOfSinglePrecisionAreStillOne) {
  TriangleMesh mesh = Cube();
  for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.points[i].x() += 1e-7 * double(i % 3);
  const auto dut = BodyOfTriangles(mesh);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->faces.size(), 6u);
}

TEST(TriangleBody, AnEdgeInPiecesIsOneEdge) {
  TriangleMesh mesh;  // two boxes of half the size side by side, without the wall between them
  const auto p = [](double x, double y, double z) { return Eigen::Vector3d(x, y, z); };
  for (const double x : {0.0, 0.5}) {
    AddSquare(mesh, p(x, 0, 0), p(x, 1, 0), p(x + 0.5, 1, 0), p(x + 0.5, 0, 0));
    AddSquare(mesh, p(x, 0, 1), p(x + 0.5, 0, 1), p(x + 0.5, 1, 1), p(x, 1, 1));
    AddSquare(mesh, p(x, 0, 0), p(x + 0.5, 0, 0), p(x + 0.5, 0, 1), p(x, 0, 1));
    AddSquare(mesh, p(x, 1, 0), p(x, 1, 1), p(x + 0.5, 1, 1), p(x + 0.5, 1, 0));
  }
  AddSquare(mesh, p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  AddSquare(mesh, p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1));
  const auto dut = BodyOfTriangles(mesh);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->faces.size(), 6u);
  EXPECT_EQ(VisibleSkeleton(*dut, {5, 6, 7}).edges.size(), 9u);
}

TEST(TriangleBody, AroundAHoleNoSeamIsSeen) {
  TriangleMesh mesh;  // a square frame in the plane z = 0, of eight triangles
  const auto ring = [](double r, int i) {
    const double a = (2 * i + 1) * std::acos(-1.0) / 4;
    return Eigen::Vector3d(r * std::sqrt(2) * std::cos(a), r * std::sqrt(2) * std::sin(a), 0);
  };
  for (int i = 0; i < 4; ++i) AddSquare(mesh, ring(2, i), ring(2, i + 1), ring(1, i + 1), ring(1, i));
  const auto dut = BodyOfTriangles(mesh);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_NEAR(LengthSeen(*dut, {0.1, 0.2, 9}), 4 * 4 + 4 * 2, 1e-6);
  EXPECT_NEAR(LengthSeen(*dut, {0.1, 0.2, -9}), 0, 1e-9) << "from behind";
}

TEST(TriangleBody, AMeshThatIsTurnedInsideOutIsTurnedBack) {
  TriangleMesh inside_out = Cube();
  for (auto& t : inside_out.triangles) std::swap(t[1], t[2]);
  TriangleMesh mixed = Cube();
  for (std::size_t i = 0; i < mixed.triangles.size(); i += 2)
    std::swap(mixed.triangles[i][1], mixed.triangles[i][2]);
  for (const TriangleMesh& mesh : {inside_out, mixed}) {
    const auto dut = BodyOfTriangles(mesh);
    ASSERT_TRUE(dut) << dut.reason();
    EXPECT_EQ(dut->faces.size(), 6u);
    EXPECT_EQ(VisibleSkeleton(*dut, {5, 6, 7}).edges.size(), 9u);
    EXPECT_TRUE(VisibleSkeleton(*dut, {0.5, 0.5, 0.5}).edges.empty()) << "from inside";
  }
}

TEST(TriangleBody, AnOpenSheetLooksWhereMostOfItDoes) {
  TriangleMesh mesh;
  const auto p = [](double x, double y) { return Eigen::Vector3d(x, y, 0); };
  AddSquare(mesh, p(0, 0), p(3, 0), p(3, 1), p(0, 1));
  AddSquare(mesh, p(3, 1), p(4, 1), p(4, 0), p(3, 0));  // clockwise
  const auto dut = BodyOfTriangles(mesh);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->faces.size(), 1u);
  EXPECT_EQ(VisibleSkeleton(*dut, {1, 0.5, 4}).edges.size(), 4u);
}

TEST(TriangleBody, ATriangleWithoutAreaIsNoFace) {
  TriangleMesh mesh = Cube();
  mesh.triangles.push_back({0, 1, 0});
  mesh.points.push_back({0, 0.5, 0});  // on an edge
  mesh.triangles.push_back({0, static_cast<int>(mesh.points.size()) - 1, 1});
  const auto dut = BodyOfTriangles(mesh);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_EQ(dut->faces.size(), 6u);
}

TEST(TriangleBody, ARoundBodyIsRefused) {
  TriangleMesh mesh;
  constexpr int kAround = 60;
  const auto at = [](int i, int j) {
    const double a = 2 * std::acos(-1.0) * i / kAround, b = std::acos(-1.0) * (j + 0.5) / 20;
    return Eigen::Vector3d(std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b));
  };
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < 19; ++j) AddSquare(mesh, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
  const auto dut = BodyOfTriangles(mesh);
  ASSERT_FALSE(dut);
  EXPECT_THAT(dut.reason(), HasSubstr("flat faces"));
}

TEST(TriangleBody, WhatIsNoMeshIsRefused) {
  TriangleMesh mesh = Cube();
  mesh.triangles[3][1] = 99;
  EXPECT_THAT(BodyOfTriangles(mesh).reason(), HasSubstr("got 99"));
  mesh = Cube();
  mesh.points[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(BodyOfTriangles(mesh).reason(), HasSubstr("coordinates"));
  EXPECT_THAT(BodyOfTriangles({}).reason(), HasSubstr("got none"));
  EXPECT_FALSE(BodyOfTriangles({{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2}}})) << "a point";
}

}  // namespace
}  // namespace priamos::head
