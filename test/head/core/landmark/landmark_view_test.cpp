#include "head/core/landmark/landmark_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/prediction.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

const Eigen::Matrix3d kTwentyCentimetresFiveDegrees =
    Eigen::Vector3d(0.115 * 0.115, 0.115 * 0.115, 0.05 * 0.05).asDiagonal();

int Count(const LandmarkView& view, ViewedEdge::Kind kind) {
  return static_cast<int>(
      std::count_if(view.edges.begin(), view.edges.end(), [&](const auto& e) { return e.kind == kind; }));
}

class LandmarkViewTest : public testing::Test {
 protected:
  /// Looks at `quads` and returns what both pictures show of the door.
  std::array<LandmarkView, 2> Look(const std::vector<test::Quad>& quads, const Pose2& truth,
                                   const Pose2& believed) {
    EdgeOperator op;
    op.Extract(test::RenderQuads(quads, Lift(truth), left_, 3, rng_), edges_[0]);
    op.Extract(test::RenderQuads(quads, Lift(truth), right_, 3, rng_), edges_[1]);
    const LandmarkPrediction expected{believed, kTwentyCentimetresFiveDegrees};
    const StereoViews views{MakeView(left_, edges_[0]), MakeView(right_, edges_[1])};
    fix_ = finder_.Find(model_, expected, views);
    return {ViewLandmark(model_, expected, fix_, views[0], 0),
            ViewLandmark(model_, expected, fix_, views[1], 1)};
  }

  Rng rng_{7};
  const CameraModel left_ = test::HeadCamera(0, 1, 1000, -0.05),
                    right_ = test::HeadCamera(0, -1, 1000, -0.05);
  const LandmarkModel model_ = test::DoorModel();
  const LandmarkFinder finder_{LandmarkFixOptions{}};
  std::array<EdgeImage, 2> edges_;
  LandmarkFix fix_;
};

TEST_F(LandmarkViewTest, AFoundDoorIsMatchedWhereItsModelLies) {
  const Pose2 truth{3.2, 0.05, 0.02};
  const auto views = Look(test::DoorQuads(), truth, {3.3, 0.15, 0.05});
  ASSERT_EQ(fix_.verdict, Verdict::kFound);
  EXPECT_EQ(Count(views[0], ViewedEdge::kMatched) + Count(views[1], ViewedEdge::kMatched), fix_.n_matched);
  const auto true_edges =
      PredictEdges(model_, truth, Eigen::Matrix3d::Zero(), left_, {edges_[0].width, edges_[0].height});
  for (const ViewedEdge& edge : views[0].edges) {
    if (edge.kind != ViewedEdge::kMatched) continue;
    const bool lies_on_one = std::any_of(true_edges.begin(), true_edges.end(), [&](const PredictedEdge& e) {
      return std::abs(e.normal().dot(edge.p - e.p)) < 2 && std::abs(e.normal().dot(edge.q - e.p)) < 2;
    });
    EXPECT_TRUE(lies_on_one) << edge.p.transpose() << " to " << edge.q.transpose();
  }
}

TEST_F(LandmarkViewTest, PredictedEdgesLieWhereThePoseSays) {
  const Pose2 believed{3.3, 0.15, 0.05};
  const auto views = Look(test::DoorQuads(), {3.2, 0.05, 0.02}, believed);
  const auto expected = PredictEdges(model_, believed, kTwentyCentimetresFiveDegrees, left_,
                                     {edges_[0].width, edges_[0].height});
  ASSERT_GE(Count(views[0], ViewedEdge::kPredicted), static_cast<int>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(views[0].edges[i].kind, ViewedEdge::kPredicted);
    EXPECT_LT((views[0].edges[i].p - expected[i].p).norm(), 1e-9);
  }
}

TEST_F(LandmarkViewTest, OfADoorOfAnotherWidthWhatIsNotTakenIsRejected) {
  const auto views = Look(test::DoorQuads(0.8), {3.2, 0, 0}, {3.2, 0, 0});
  ASSERT_NE(fix_.verdict, Verdict::kFound);
  EXPECT_GT(Count(views[0], ViewedEdge::kRejected), 0);
}

TEST_F(LandmarkViewTest, ABareWallHasPredictionsOnly) {
  const auto views = Look(test::WallQuads(), {3.2, 0, 0}, {3.2, 0, 0});
  EXPECT_GT(Count(views[0], ViewedEdge::kPredicted), 4);
  EXPECT_EQ(Count(views[0], ViewedEdge::kMatched), 0);
}

TEST_F(LandmarkViewTest, RejectedEdgesAreBoundedAndTheRestIsCounted) {
  std::vector<test::Quad> stripes = test::WallQuads();
  for (int i = 0; i < 60; ++i)
    stripes.push_back({{-0.1, -1.2 + 0.04 * i, 0.2}, {0, 0.02, 0}, {0, 0, 1.8}, i % 2 ? 30.0 : 220.0});
  const auto views = Look(stripes, {3.2, 0, 0}, {3.2, 0, 0});
  EXPECT_EQ(Count(views[0], ViewedEdge::kRejected), LandmarkViewOptions{}.max_rejected);
  EXPECT_GT(views[0].n_left_out, 10);
}

TEST_F(LandmarkViewTest, TheTellingPictureIsTheOneThatMissedMore) {
  LandmarkFix fix;
  fix.verdict = Verdict::kTooFewEdges;
  EXPECT_EQ(CameraToShow(fix), 0);
  fix.matches.resize(3);
  fix.matches[2].camera = 1;
  EXPECT_EQ(CameraToShow(fix), 1);
  fix.verdict = Verdict::kFound;
  EXPECT_EQ(CameraToShow(fix), 0);
}

}  // namespace
}  // namespace priamos::head
