#include "planner/core/graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::planner {
namespace {

GraphMotion Step(int from, const Pose2& by) {
  return {from, from + 1, by, {0.01, 0.01, Radians(0.5)}};
}

TEST(PoseGraph, StaysWhereNothingContradicts) {
  PoseGraph graph;
  graph.AddPose({1, 2, 0.3});
  graph.AddPose(Pose2{1, 2, 0.3} * Pose2{1, 0, 0.2});
  graph.Add(Step(0, {1, 0, 0.2}));
  EXPECT_NEAR(graph.Adjust(), 0, 1e-9);
  EXPECT_EQ(graph.pose(0).x, 1);
  EXPECT_NEAR(graph.pose(1).yaw, 0.5, 1e-9);
}

/// A line that was seen before and after a turn of which the wheels told 2 degrees too little.
PoseGraph SeenTwice(double wrong_rad) {
  PoseGraph graph;
  graph.AddPose({});
  graph.AddPose({1, 0, -wrong_rad});
  graph.Add(Step(0, {1, 0, -wrong_rad}));
  graph.AddLine({{0.5, 1}, kPi, 0});
  graph.Add(GraphSight{0, 0, {0.5, 1, kPi}, 0.005, Radians(0.05)});
  graph.Add(GraphSight{1, 0, {-0.5, 1, kPi}, 0.005, Radians(0.05)});
  return graph;
}

TEST(PoseGraph, ALineSeenAgainMendsTheHeading) {
  PoseGraph graph = SeenTwice(Radians(1.5));
  graph.FollowAll();
  graph.Adjust();
  EXPECT_NEAR(Degrees(graph.pose(1).yaw), 0, 0.1);
}

TEST(PoseGraph, ASightThatContradictsTheRestIsNotFollowed) {
  PoseGraph graph = SeenTwice(0);
  graph.Add(GraphSight{1, 0, {-0.5, 1.5, kPi - 0.3}, 0.005, Radians(0.05)});
  graph.Adjust();
  EXPECT_NEAR(graph.pose(1).y, 0, 0.005);
  EXPECT_NEAR(graph.line(0).offset_m, 0, 0.005);
}

/// Two walls at right angles, each seen from its pose, and a wrong turn between.
PoseGraph Corner(double between_rad) {
  PoseGraph graph;
  graph.AddPose({});
  graph.AddPose({1, 0, kPi / 2});
  graph.Add(Step(0, {1, 0, kPi / 2}));
  graph.AddLine({{0, 1}, kPi, 0});
  graph.Add(GraphSight{0, 0, {0, 1, kPi}, 0.01, Radians(0.1)});
  graph.AddLine({{2, 0}, kPi / 2 + between_rad, 0});
  graph.Add(GraphSight{1, 1, {0, -1, between_rad}, 0.01, Radians(0.1)});
  return graph;
}

TEST(PoseGraph, WallsThatAreNearlySquareMendTheHeading) {
  PoseGraph graph = Corner(Radians(1));
  graph.SetSquare(SquarePrior{Radians(0.1), 30});
  graph.Adjust();
  EXPECT_NEAR(Degrees(graph.pose(1).yaw), 89, 0.2);
}

TEST(PoseGraph, AWallThatStandsAskewDoesNot) {
  PoseGraph graph = Corner(Radians(20));
  graph.SetSquare(SquarePrior{Radians(0.5), 2});
  graph.Adjust();
  EXPECT_NEAR(Degrees(graph.pose(1).yaw), 90, 0.1);
}

TEST(PoseGraph, TellsHowWellALineIsKnown) {
  PoseGraph graph = SeenTwice(0);
  EXPECT_FALSE(graph.CovarianceOf({GraphNode{.index = 0}}));
  graph.Adjust();
  const auto covariance = graph.CovarianceOf({GraphNode{.index = 0}});
  ASSERT_TRUE(covariance);
  EXPECT_LT(std::sqrt((*covariance)(1, 1)), 0.006);
  EXPECT_GT(std::sqrt((*covariance)(1, 1)), 0.002);
  graph.AddLine({});
  EXPECT_FALSE(graph.CovarianceOf({GraphNode{.index = 1}}));
}

TEST(PoseGraph, JoinedLinesAreOne) {
  PoseGraph graph = SeenTwice(0);
  graph.AddLine({{0.5, 1.2}, kPi, 0});
  graph.Add(GraphSight{1, 1, {-0.5, 1.2, kPi}, 0.005, Radians(0.05)});
  graph.Join(0, 1);
  for (const GraphSight& sight : graph.sights()) EXPECT_EQ(sight.line, 0);
  graph.Adjust();
  EXPECT_TRUE(std::isfinite(graph.line(1).yaw_rad));
}

/// A point that is heard from two poses mends the way between them in both directions.
TEST(PoseGraph, APointHeardTwiceTiesTwoPoses) {
  PoseGraph graph;
  graph.AddPose({0, 0, 0});
  graph.AddPose({2.2, 0.1, 0});
  graph.Add(GraphMotion{0, 1, {2.2, 0.1, 0}, {0.2, 0.2, 0.001}});
  graph.AddPoint({1, 1});
  graph.Add(GraphPointSight{0, 0, {1, 1}, 0.01});
  graph.Add(GraphPointSight{1, 0, {-1, 1}, 0.01});
  graph.FollowAll();
  graph.Adjust();
  EXPECT_NEAR(graph.pose(1).x, 2, 0.02);
  EXPECT_NEAR(graph.pose(1).y, 0, 0.02);
  const auto covariance = graph.CovarianceOf({{GraphNode::Kind::kPoint, 0}});
  ASSERT_TRUE(covariance);
  EXPECT_NEAR(std::sqrt((*covariance)(0, 0)), 0.01, 0.005);
}

TEST(PoseGraph, JoinedPointsAreOne) {
  PoseGraph graph;
  graph.AddPose({0, 0, 0});
  graph.AddPoint({1, 1});
  graph.AddPoint({1.1, 1});
  graph.Add(GraphPointSight{0, 0, {1, 1}, 0.01});
  graph.Add(GraphPointSight{0, 1, {1.02, 1}, 0.01});
  graph.JoinPoints(0, 1);
  graph.Adjust();
  EXPECT_NEAR(graph.point(0).x(), 1.01, 0.005);
  EXPECT_NEAR(graph.DistanceOf(GraphPointSight{0, 0, {1, 1}, 0.01}), 1, 0.5);
}

}  // namespace
}  // namespace priamos::planner
