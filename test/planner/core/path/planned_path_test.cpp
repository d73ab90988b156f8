#include "planner/core/path/planned_path.hpp"

#include <gtest/gtest.h>

namespace priamos::planner {
namespace {

PlannedPath PathOf(std::size_t points) {
  PlannedPath path;
  for (std::size_t i = 0; i < points; ++i) path.points.push_back({static_cast<double>(i), 0, 0});
  path.leeway.assign(points, {0.2, 0.3});
  return path;
}

TEST(PlannedPath, FirstPartIsWhatTheRobotTakesAtOnce) {
  const PlannedPath part = FirstPart(PathOf(kMostPathPoints + 3));
  EXPECT_EQ(part.points.size(), kMostPathPoints);
  EXPECT_EQ(part.leeway.size(), kMostPathPoints);
  EXPECT_EQ(part.points.back().x, kMostPathPoints - 1);
}

TEST(PlannedPath, AShortPathIsItsOwnFirstPart) {
  const PlannedPath part = FirstPart(PathOf(2));
  EXPECT_EQ(part.points.size(), 2u);
  EXPECT_EQ(part.leeway.size(), 2u);
}

}  // namespace
}  // namespace priamos::planner
