#include "head/core/bodies/polyhedron.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace priamos::head {
namespace {

using testing::HasSubstr;

/// Between (0, 0, 0) and `size`, moved by `at`; faces counter-clockwise from outside.
void AddBox(Polyhedron& body, const Eigen::Vector3d& at, const Eigen::Vector3d& size) {
  const int n = static_cast<int>(body.points.size());
  for (int i = 0; i < 8; ++i)
    body.points.push_back(at +
                          Eigen::Vector3d((i & 1) * size.x(), (i >> 1 & 1) * size.y(), (i >> 2) * size.z()));
  for (const std::vector<int>& face :
       {std::vector<int>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    body.faces.push_back(face);
    for (int& corner : body.faces.back()) corner += n;
  }
}

Polyhedron Cube() {
  Polyhedron body;
  AddBox(body, {0, 0, 0}, {1, 1, 1});
  return body;
}

double Length(const LandmarkModel& model) {
  double sum = 0;
  for (const LandmarkEdge& e : model.edges) sum += (e.to - e.from).norm();
  return sum;
}

TEST(Polyhedron, NineEdgesOfACubeAreSeenFromACorner) {
  EXPECT_EQ(VisibleSkeleton(Cube(), {5, 6, 7}).edges.size(), 9u);
}

TEST(Polyhedron, FourEdgesAreSeenFromTheFront) {
  const LandmarkModel dut = VisibleSkeleton(Cube(), {5, 0.5, 0.5});
  EXPECT_EQ(dut.edges.size(), 4u);
  for (const LandmarkEdge& e : dut.edges) EXPECT_EQ(e.from.x(), 1);
}

TEST(Polyhedron, FromInsideNothingIsSeen) {
  EXPECT_TRUE(VisibleSkeleton(Cube(), {0.5, 0.5, 0.5}).edges.empty());
}

TEST(Polyhedron, BetweenLevelFacesOfOneGreyNothingIsSeen) {
  Polyhedron dut;
  dut.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  dut.faces = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(VisibleSkeleton(dut, {0.4, 0.5, 5}).edges.size(), 4u);
  dut.greys = {100, 150};
  EXPECT_EQ(VisibleSkeleton(dut, {0.4, 0.5, 5}).edges.size(), 5u);
}

TEST(Polyhedron, ABoxBeforeAnotherHidesPartOfItsEdges) {
  Polyhedron body = Cube();
  const double alone = Length(VisibleSkeleton(body, {10, 0.5, 0.5}));
  AddBox(body, {2, -1, -1}, {0.1, 3, 1.5});  // hides the lower half of the front
  double behind = 0;
  for (const LandmarkEdge& e : VisibleSkeleton(body, {10, 0.5, 0.5}).edges)
    if (e.from.x() == 1) behind += (e.to - e.from).norm();
  EXPECT_NEAR(alone, 4, 1e-9);
  EXPECT_NEAR(behind, 2, 0.15);  // the upper edge, and half of both sides
}

TEST(Polyhedron, ALineIsSeenUnlessAFaceIsBeforeIt) {
  Polyhedron body = Cube();
  body.points.push_back({-1, 0.5, 0.4});
  body.points.push_back({-1, 0.5, 0.6});
  body.lines.push_back({8, 9});
  EXPECT_EQ(VisibleSkeleton(body, {5, 0.5, 0.5}).edges.size(), 4u);
  EXPECT_EQ(VisibleSkeleton(body, {-5, 0.5, 0.5}).edges.size(), 5u);
}

TEST(Polyhedron, BetweenTwoFacesThatAreSeenTheRatioOfGreysIsKnown) {
  Polyhedron body = Cube();
  body.greys = {0, 100, 50, 0, 0, 200};  // top 100, y = 0 50, x = 1 200
  int known = 0;
  for (const LandmarkEdge& e : VisibleSkeleton(body, {5, -4, 6}).edges) {
    const bool upright = e.from.head<2>().isApprox(e.to.head<2>());
    if (!e.grey_ratio) continue;
    ++known;
    // Seen from there x = 1 is on the right of the common upright edge, and upwards right is right.
    const double upwards = e.to.z() > e.from.z() ? 1 : -1;
    if (upright) {
      EXPECT_NEAR(*e.grey_ratio, upwards * std::log(200.0 / 50), 1e-9);
    }
  }
  EXPECT_EQ(known, 3);
  for (const LandmarkEdge& e : VisibleSkeleton(body, {5, 0.5, 0.5}).edges) EXPECT_FALSE(e.grey_ratio);
  for (const LandmarkEdge& e : VisibleSkeleton(Cube(), {5, -4, 6}).edges) EXPECT_FALSE(e.grey_ratio);
}

TEST(Polyhedron, NonsenseIsNamed) {
  EXPECT_FALSE(CheckPolyhedron(Cube()));
  EXPECT_THAT(CheckPolyhedron({})->reason, HasSubstr("at least one face"));
  Polyhedron body = Cube();
  body.faces[2] = {0, 1};
  EXPECT_THAT(CheckPolyhedron(body)->reason, HasSubstr("face 2: expected 3 corners"));
  body.faces[2] = {0, 1, 8};
  EXPECT_THAT(CheckPolyhedron(body)->reason, HasSubstr("points 0 to 7, got 8"));
  body.faces[2] = {0, 1, 1};
  EXPECT_THAT(CheckPolyhedron(body)->reason, HasSubstr("span a plane"));
  body.faces[2] = {0, 1, 5, 6};
  EXPECT_THAT(CheckPolyhedron(body)->reason, HasSubstr("in one plane"));
  body = Cube();
  body.points[3].x() = std::nan("");
  EXPECT_THAT(CheckPolyhedron(body)->reason, HasSubstr("point 3"));
  body = Cube();
  body.greys = {100};
  EXPECT_THAT(CheckPolyhedron(body)->reason, HasSubstr("greys of all 6 faces"));
  body.greys = {1, 2, 3, 4, 5, 300};
  EXPECT_THAT(CheckPolyhedron(body)->reason, HasSubstr("0 to 255, got 300"));
}

}  // namespace
}  // namespace priamos::head
