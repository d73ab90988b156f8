#include "planner/core/missions/path_progress.hpp"

#include <gmock/gmock.h>

namespace priamos::planner {
namespace {

using ::testing::SizeIs;

const std::vector<Pose2> kPath{{1, 0, 0}, {1, 2, 0}, {4, 2, 0}};

TEST(PathProgressTest, ThePointsThatAreLeft) {
  EXPECT_THAT(PointsLeft(kPath, 6), SizeIs(3));
  EXPECT_THAT(PointsLeft(kPath, 5.5), SizeIs(3));
  EXPECT_THAT(PointsLeft(kPath, 4), SizeIs(2));
  EXPECT_THAT(PointsLeft(kPath, 3), SizeIs(1));
  EXPECT_THAT(PointsLeft(kPath, 0), SizeIs(1));
  EXPECT_THAT(PointsLeft({}, 1), SizeIs(0));
}

}  // namespace
}  // namespace priamos::planner
