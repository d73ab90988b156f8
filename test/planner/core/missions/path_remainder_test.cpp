#include "planner/core/missions/path_remainder.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace priamos::planner {
namespace {

PathOrder Path(std::vector<Pose2> points) {
  PathOrder path{.path_id = 1, .speed_m_s = 0.3, .points = std::move(points)};
  for (std::size_t i = 0; i < path.points.size(); ++i) path.leeway.push_back({0.1 * double(i), 0});
  return path;
}

TEST(PathRemainder, WhatIsBehindIsLeftOut) {
  const PathOrder path = Path({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}});
  const PathOrder left = RemainderOf(path, {0, 0, 0}, 1.5, {1.5, 0.02, 0});
  ASSERT_EQ(left.points.size(), 2u);
  EXPECT_EQ(left.points[0].x, 2);
  ASSERT_EQ(left.leeway.size(), 2u);
  EXPECT_EQ(left.leeway[0].left_m, 0.1) << "that of the line";
  EXPECT_EQ(left.speed_m_s, 0.3);
}

TEST(PathRemainder, AtTheEndTheLastPointIsLeftAndOfNoPathNothing) {
  EXPECT_EQ(RemainderOf(Path({{1, 0, 0}, {2, 0, 0}}), {0, 0, 0}, 0, {2, 0, 0}).points.size(), 1u);
  EXPECT_TRUE(RemainderOf(Path({}), {0, 0, 0}, 0, {2, 0, 0}).points.empty());
}

/// There and back on the same line: only the report tells on which of both ways it is.
TEST(PathRemainder, APathThatCrossesItselfIsGoneOnWithWhereTheRobotReportedToBe) {
  const PathOrder path = Path({{3, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(RemainderOf(path, {0, 0, 0}, 5, {1.2, 0, 0}).points.size(), 2u) << "on the way there";
  EXPECT_EQ(RemainderOf(path, {0, 0, 0}, 1.4, {1.2, 0, 0}).points.size(), 1u) << "on the way back";
}

RC_GTEST_PROP(PathRemainder, FromAnyPlaceOnAPathTheRestIsAheadOfIt, ()) {
  const auto n = *rc::gen::inRange<std::size_t>(1, 8);
  const auto coordinate = rc::gen::map(rc::gen::inRange(-500, 500), [](int cm) { return cm / 100.0; });
  std::vector<Pose2> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back({*coordinate, *coordinate, 0});
  const Pose2 start{*coordinate, *coordinate, 0};
  const auto on = *rc::gen::inRange<std::size_t>(0, n);
  const double part = *rc::gen::inRange(0, 101) / 100.0;
  const Eigen::Vector2d from = on == 0 ? start.translation() : points[on - 1].translation();
  const Eigen::Vector2d at = from + part * (points[on].translation() - from);
  const Pose2 robot{at.x(), at.y(), 0};
  const std::vector<Pose2> after(points.begin() + std::ptrdiff_t(on), points.end());
  const double remaining_m = LengthOf(robot, after);
  // The report is up to a second old.
  const PathOrder left =
      RemainderOf(Path(points), start, remaining_m + *rc::gen::inRange(0, 30) / 100.0, robot);
  RC_ASSERT(!left.points.empty());
  RC_ASSERT(left.points.back().translation() == points.back().translation());
  // It stands on the line to the first point that is left, and what is left is not much longer or shorter.
  const double to_drive_m = LengthOf(robot, left.points);
  RC_ASSERT(to_drive_m >= remaining_m - 0.8 - 1e-9);
  RC_ASSERT(to_drive_m <= remaining_m + 0.8 + 1e-9);
}

}  // namespace
}  // namespace priamos::planner
