#include "head/core/landmark/edge_candidates.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "test/head/exact_view.hpp"
#include "test/support/generated_numbers.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::Between;

PredictedEdge Predicted(const Vector2d& p, const Vector2d& q) {
  PredictedEdge edge;
  edge.p = p;
  edge.q = q;
  return edge;
}

/// A prediction from (100, 200), 100 px to the right: its normal points down.
class EdgeCandidatesTest : public testing::Test {
 protected:
  /// Draws a line from `along`, `aside` of the prediction's frame to another such point.
  void Draw(const Vector2d& from, const Vector2d& to) { scene_.Draw(start_ + from, start_ + to); }
  std::vector<EdgeCandidate> Find(double reach_px = 5, double max_angle_rad = 0.05) {
    const CameraView view = scene_.View();
    CandidateSearch dut(view, reach_px, max_angle_rad);
    std::vector<EdgeCandidate> found;
    dut.Find(Predicted(start_, start_ + Vector2d(100, 0)), found);
    return found;
  }
  const Vector2d start_{100, 200};
  test::ExactView scene_{test::HeadCamera(0, 1)};
};

TEST_F(EdgeCandidatesTest, ALineOnThePredictionCoversAllOfIt) {
  Draw({0, 0}, {100, 0});
  const auto found = Find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].line, 0);
  EXPECT_NEAR(found[0].from, 0, 1e-6);
  EXPECT_NEAR(found[0].to, 100, 1e-6);
  EXPECT_NEAR(found[0].before, 0, 1e-6);
  EXPECT_NEAR(found[0].after, 0, 1e-6);
  EXPECT_NEAR(found[0].distance, 0, 1e-6);
  EXPECT_TRUE(found[0].same_sign);
}

TEST_F(EdgeCandidatesTest, TheBrightSideTellsTheSign) {
  Draw({100, 0}, {0, 0});
  const auto found = Find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].same_sign);
  EXPECT_NEAR(found[0].from, 0, 1e-6);
  EXPECT_NEAR(found[0].to, 100, 1e-6);
}

TEST_F(EdgeCandidatesTest, WhatRunsOnBeyondTheEndsIsTold) {
  Draw({-30, 1}, {112, 1});
  const auto found = Find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].from, 0, 1e-6);
  EXPECT_NEAR(found[0].to, 100, 1e-6);
  EXPECT_NEAR(found[0].before, 30, 1e-6);
  EXPECT_NEAR(found[0].after, 12, 1e-6);
}

TEST_F(EdgeCandidatesTest, DistanceIsPositiveOnTheSideOfTheNormal) {
  Draw({20, 3}, {60, 3});
  Draw({20, -2}, {60, -2});
  const auto found = Find();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].distance, 3, 1e-6);
  EXPECT_NEAR(found[1].distance, -2, 1e-6);
  EXPECT_NEAR(found[0].from, 20, 1e-6);
  EXPECT_NEAR(found[0].to, 60, 1e-6);
}

TEST_F(EdgeCandidatesTest, DistanceIsThatAtTheMiddleOfTheCommonPart) {
  Draw({50, 0}, {150, 4});  // common from 50 to 100: at 75 it is 1
  const auto found = Find();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].distance, 1, 1e-4);
}

TEST_F(EdgeCandidatesTest, ALineMayComeFromFarBeside) {
  Draw({-100, -7}, {100, 1});
  Draw({-100, 7}, {100, -1});
  const auto found = Find();
  ASSERT_EQ(found.size(), 2u) << "7 px beside where the prediction does not reach";
  EXPECT_NEAR(found[0].distance, -1, 1e-4);
  EXPECT_NEAR(found[1].distance, 1, 1e-4);
}

TEST_F(EdgeCandidatesTest, TheReachHasABound) {
  Draw({0, 4.9}, {100, 4.9});
  Draw({0, 5.1}, {100, 5.1});
  Draw({0, -5.1}, {100, -5.1});
  ASSERT_EQ(Find().size(), 1u);
  EXPECT_EQ(Find()[0].line, 0);
  EXPECT_EQ(Find(5.2).size(), 3u);
}

TEST_F(EdgeCandidatesTest, TurnedLinesAreAcceptedUpToAnAngleAndAPixel) {
  // 100 px allow 5 + 1 px
  Draw({0, -3}, {100, 2.9});
  Draw({0, -3}, {100, 3.1});
  ASSERT_EQ(Find().size(), 1u);
  EXPECT_EQ(Find()[0].line, 0);
  EXPECT_EQ(Find(5, 0.06).size(), 2u);
}

TEST_F(EdgeCandidatesTest, ALineThatTouchesOnlyTheEndIsNoCandidate) {
  Draw({-50, 0}, {3, 0});
  Draw({97, 0}, {150, 0});
  Draw({120, 0}, {150, 0});
  EXPECT_TRUE(Find().empty());
  Draw({-50, 0}, {5, 0});
  ASSERT_EQ(Find().size(), 1u);
  EXPECT_NEAR(Find()[0].to, 5, 1e-6);
}

TEST_F(EdgeCandidatesTest, FindAddsToWhatIsThere) {
  Draw({0, 0}, {100, 0});
  const CameraView view = scene_.View();
  CandidateSearch dut(view, 5, 0.05);
  std::vector<EdgeCandidate> found;
  for (int i = 1; i <= 2; ++i) {
    dut.Find(Predicted({100, 200}, {200, 200}), found);
    EXPECT_EQ(int(found.size()), i);
  }
  dut.Find(Predicted({100, 400}, {200, 400}), found);
  EXPECT_EQ(found.size(), 2u) << "nothing is left of the edge before";
}

TEST_F(EdgeCandidatesTest, NoLinesNoCandidates) {
  EXPECT_TRUE(Find().empty());
}

Vector2d AnyPixel() {
  return {Between(50, 700), Between(50, 500)};
}

RC_GTEST_PROP(CandidateSearchTest, ManyLinesAreFoundAsEachOfThemAlone, ()) {
  const Vector2d p = AnyPixel(), q = AnyPixel();
  RC_PRE((q - p).norm() > 60);
  const PredictedEdge edge = Predicted(p, q);
  const Vector2d along = edge.direction(), normal = edge.normal();
  test::ExactView all(test::HeadCamera(0, 1));
  std::vector<int> alone;
  for (int i = 0; i < 20; ++i) {
    const double s = Between(-60, 40), t = s + Between(20, 120), a = Between(-9, 9), b = a + Between(-9, 9);
    const Vector2d from = p + s * along + a * normal, to = p + t * along + b * normal;
    all.Draw(from, to, 80, 140, 0);
    test::ExactView one(test::HeadCamera(0, 1));
    one.Draw(from, to, 80, 140, 0);
    const CameraView view = one.View();
    std::vector<EdgeCandidate> found;
    CandidateSearch(view, 6, 0.08).Find(edge, found);
    if (!found.empty()) alone.push_back(i);
  }
  const CameraView view = all.View();
  std::vector<EdgeCandidate> found;
  CandidateSearch(view, 6, 0.08).Find(edge, found);
  std::vector<int> lines;
  for (const EdgeCandidate& c : found) {
    lines.push_back(c.line);
    RC_ASSERT(c.from >= 0 && c.to > c.from && c.to <= edge.length_px() + 1e-9);
    RC_ASSERT(std::abs(c.distance) <= 6 && c.before >= 0 && c.after >= 0);
  }
  RC_ASSERT(lines == alone);
}

}  // namespace
}  // namespace priamos::head
