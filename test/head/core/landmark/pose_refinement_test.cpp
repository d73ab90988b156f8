#include "head/core/landmark/pose_refinement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

class PoseRefinementTest : public testing::Test {
 protected:
  PoseRefinementTest() {
    EdgeOperator op;
    op.Extract(test::RenderQuads(test::DoorQuads(), Lift(truth_), left_, 2, rng_, 60), edges_[0]);
    op.Extract(test::RenderQuads(test::DoorQuads(), Lift(truth_), right_, 2, rng_, 60), edges_[1]);
    options_.solver.model_sigma_m = 0.001;
  }

  RefinedPose Refine() {
    views_ = {MakeView(left_, edges_[0]), MakeView(right_, edges_[1])};
    const PoseRefinement dut(model_, views_, options_);
    RefinedPose pose{.base_from_landmark = {3.205, 0.016, 0.001}};
    EXPECT_TRUE(dut.Approach(pose));
    dut.Refine(pose);
    return pose;
  }

  /// Moves the image edge nearest to a model edge of camera `camera` so far across itself.
  void Move(int edge, int camera, double by_px) {
    const LandmarkEdge& moved = model_.edges[edge];
    const CameraModel& seen_by = camera == 0 ? left_ : right_;
    const auto seen = ProjectEdge(seen_by, {768, 576}, Lift(truth_) * moved.from, Lift(truth_) * moved.to);
    ASSERT_TRUE(seen);
    for (EdgeSegment& s : edges_[camera].segments) {
      if (std::abs(seen->normal().dot(s.centre - seen->p)) > 1.5 || s.length_px() < 40) continue;
      for (Eigen::Vector2d* p : {&s.begin, &s.end, &s.centre}) *p += by_px * seen->normal();
      for (int i = 0; i < s.n_points; ++i)
        edges_[camera].points[s.first_point + i].at += by_px * seen->normal();
    }
  }

  static const EdgeMatch* MatchOf(const RefinedPose& pose, int edge, int camera) {
    const auto& matches = pose.association.matches;
    const auto found = std::find_if(matches.begin(), matches.end(),
                                    [&](const EdgeMatch& m) { return m.edge == edge && m.camera == camera; });
    return found == matches.end() ? nullptr : &*found;
  }

  static constexpr int kOuterLeft = 0;
  const Pose2 truth_{3.2, 0.02, 0.003};
  Rng rng_{9};
  const CameraModel left_ = test::HeadCamera(0, 1, 1000, -0.05),
                    right_ = test::HeadCamera(0, -1, 1000, -0.05);
  const LandmarkModel model_ = test::DoorModel();
  std::array<EdgeImage, 2> edges_;
  std::array<CameraView, 2> views_;
  RefinementOptions options_;
};

TEST_F(PoseRefinementTest, AllEdgesOfACleanImageAreMeasuredBy) {
  const RefinedPose pose = Refine();
  ASSERT_TRUE(pose.solution.ok);
  EXPECT_EQ(pose.association.Measuring(), static_cast<int>(pose.association.matches.size()));
  EXPECT_NEAR(pose.base_from_landmark.y, truth_.y, 0.002);
}

TEST_F(PoseRefinementTest, AnEdgeThatAShadowMovedIsEvidenceAndNotMeasuredBy) {
  const double clean = Refine().association.log_odds;
  Move(kOuterLeft, 0, 0.4);
  const RefinedPose pose = Refine();
  ASSERT_TRUE(pose.solution.ok);
  const EdgeMatch* match = MatchOf(pose, kOuterLeft, 0);
  ASSERT_TRUE(match) << "it is still the landmark's";
  EXPECT_FALSE(match->is_measured && MatchOf(pose, kOuterLeft, 1)->is_measured);
  EXPECT_GT(pose.association.log_odds, clean - 2);
  EXPECT_NEAR(pose.base_from_landmark.y, truth_.y, 0.003);
  EXPECT_NEAR(pose.base_from_landmark.x, truth_.x, 0.008);
}

TEST_F(PoseRefinementTest, AnEdgeOfSomethingElseIsTakenOut) {
  const double clean = Refine().association.log_odds;
  Move(kOuterLeft, 0, 4);
  const RefinedPose pose = Refine();
  ASSERT_TRUE(pose.solution.ok);
  EXPECT_LT(pose.association.log_odds, clean - 3);
  EXPECT_NEAR(pose.base_from_landmark.x, truth_.x, 0.008);
}

}  // namespace
}  // namespace priamos::head
