#include "head/core/landmark/edge_observations.hpp"

#include <gtest/gtest.h>

#include "test/head/exact_view.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// One upright edge 3 m before two cameras that see it from 1 m to 1.5 m.
class EdgeObservationsTest : public testing::Test {
 protected:
  EdgeObservationsTest() {
    model_.edges.push_back({.from = {0, 0.1, 1.0}, .to = {0, 0.1, 1.5}});
    for (test::ExactView* scene : {&left_, &right_}) scene->See(OnEdge(0.0), OnEdge(1.0));
  }
  /// A point of the edge in the base frame: 0 at its lower end, 1 at its upper end.
  Vector3d OnEdge(double share) const {
    const LandmarkEdge& edge = model_.edges[0];
    return pose_ * Vector3d(edge.from + share * (edge.to - edge.from));
  }
  std::vector<EdgeObservation> Observe(const std::vector<EdgeMatch>& matches, bool coarse = false) {
    const std::vector<CameraView> views{left_.View(), right_.View()};
    Association association;
    association.matches = matches;
    return Observations(model_, association, views, pose_, coarse);
  }
  static EdgeMatch Match(int camera, std::vector<int> lines = {0}) {
    EdgeMatch match;
    match.camera = camera;
    match.lines = std::move(lines);
    return match;
  }
  double DistanceFromEdge(const EdgeObservation& o) const {
    const CameraModel& camera = (o.camera == 0 ? left_ : right_).camera();
    const Vector2d p = camera.Project(OnEdge(0)), d = (camera.Project(OnEdge(1)) - p).normalized();
    return std::abs(d.x() * (o.at - p).y() - d.y() * (o.at - p).x());
  }

  const Eigen::Isometry3d pose_ = Lift({3.25, 0, 0});
  LandmarkModel model_;
  test::ExactView left_{test::HeadCamera(0, 1, 1000, -0.1), 0.07},
      right_{test::HeadCamera(0, -1, 1000, -0.1), 0.09};
};

TEST_F(EdgeObservationsTest, EveryPointOfAMatchedSegmentIsOneUndistorted) {
  const auto dut = Observe({Match(0), Match(1)});
  ASSERT_EQ(dut.size(), left_.edges().points.size() + right_.edges().points.size());
  for (std::size_t i = 0; i < dut.size(); ++i) {
    const bool in_left = i < left_.edges().points.size();
    EXPECT_EQ(dut[i].camera, in_left ? 0 : 1) << "those of one line follow each other";
    EXPECT_EQ(dut[i].edge, 0);
    EXPECT_DOUBLE_EQ(dut[i].sigma_px, in_left ? 0.07 : 0.09);
    EXPECT_LT(DistanceFromEdge(dut[i]), 0.01);
  }
}

TEST_F(EdgeObservationsTest, OnlyMatchedLinesCount) {
  left_.See(OnEdge(0.2), OnEdge(0.4));
  const auto n = static_cast<std::size_t>(left_.edges().segments[1].n_points);
  EXPECT_EQ(Observe({Match(0, {1})}).size(), n);
  EXPECT_EQ(Observe({Match(0, {0, 1})}).size(), left_.edges().points.size());
  EXPECT_TRUE(Observe({Match(0, {})}).empty());
  EXPECT_TRUE(Observe({}).empty());
}

TEST_F(EdgeObservationsTest, PointsBeyondTheEndsOfTheModelAreLeftOut) {
  left_.See(OnEdge(-0.5), OnEdge(1.5));
  const CameraModel& camera = left_.camera();
  const double low = camera.Project(OnEdge(0)).y(), high = camera.Project(OnEdge(1)).y();
  const auto dut = Observe({Match(0, {1})});
  EXPECT_NEAR(double(dut.size()), (low - high) / 4, 2.5) << "points are 4 px apart";
  for (const EdgeObservation& o : dut) {
    EXPECT_GT(o.at.y(), high - 3.01) << "3 px beyond the end may still be its own";
    EXPECT_LT(o.at.y(), low + 3.01);
  }
}

TEST_F(EdgeObservationsTest, CoarselyALineIsItsTwoEnds) {
  const auto dut = Observe({Match(0)}, true);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_LT((dut[0].at - left_.camera().Project(OnEdge(0))).norm(), 0.02);
  EXPECT_LT((dut[1].at - left_.camera().Project(OnEdge(1))).norm(), 0.02);
  EXPECT_DOUBLE_EQ(dut[0].sigma_px, 0.3);
}

TEST_F(EdgeObservationsTest, CoarselyALongLineEndsWhereTheModelDoes) {
  left_.See(OnEdge(1.5), OnEdge(-0.5));  // the other way round
  const auto dut = Observe({Match(0, {1})}, true);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_LT((dut[0].at - left_.camera().Project(OnEdge(1))).norm(), 0.02);
  EXPECT_LT((dut[1].at - left_.camera().Project(OnEdge(0))).norm(), 0.02);
}

TEST_F(EdgeObservationsTest, AnEdgeThatTheCameraCannotSeeIsLeftOut) {
  model_.edges.push_back({.from = {-5, 0.1, 1.0}, .to = {-5, 0.1, 1.5}});  // behind the cameras
  EdgeMatch behind = Match(0);
  behind.edge = 1;
  EXPECT_TRUE(Observe({behind}).empty());
  EXPECT_FALSE(Observe({behind, Match(0)}).empty());
}

}  // namespace
}  // namespace priamos::head
