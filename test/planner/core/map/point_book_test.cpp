#include "planner/core/map/point_book.hpp"

#include <gmock/gmock.h>

namespace priamos::planner {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

LearnedPoint At(double x_m, double seen_s = 1000) {
  return {x_m, 0, 0.02, seen_s};
}

class PointBookTest : public testing::Test {
 protected:
  std::vector<LearnedPoint> points_;
  PointBook dut_;
};

TEST_F(PointBookTest, WhatAnotherRunFoundIsOneByItsPlace) {
  points_ = {{1, 0, 0.02, 500, 4}};
  dut_.Take({2, 9}, At(1.1), points_);
  ASSERT_THAT(points_, SizeIs(1));
  EXPECT_EQ(points_[0].id, 4);
  EXPECT_EQ(points_[0].x_m, 1.1) << "where it was told last";
  dut_.Take({2, 9}, At(1.5), points_);
  ASSERT_THAT(points_, SizeIs(1)) << "nobody else says that one is there";
  EXPECT_EQ(points_[0].x_m, 1.5);
}

TEST_F(PointBookTest, OneOfTwoThatTurnsOutElsewhereLeavesTheOther) {
  dut_.Take({1, 1}, At(1), points_);
  dut_.Take({1, 2}, At(1.15), points_);
  ASSERT_THAT(points_, SizeIs(1));
  dut_.Take({1, 2}, At(1.5), points_);
  ASSERT_THAT(points_, SizeIs(2));
  EXPECT_TRUE(dut_.Forget({1, 2}, points_));
  ASSERT_THAT(points_, SizeIs(1));
  EXPECT_NEAR(points_[0].x_m, 1, 0.15);
}

TEST_F(PointBookTest, APointThatMovesOntoAnotherIsOneWithIt) {
  dut_.Take({1, 1}, At(1), points_);
  dut_.Take({1, 2}, At(2), points_);
  dut_.Take({1, 2}, At(1.1), points_);
  ASSERT_THAT(points_, SizeIs(1));
  EXPECT_EQ(points_[0].id, 1);
  EXPECT_EQ(points_[0].x_m, 1.1);
  EXPECT_TRUE(dut_.Forget({1, 1}, points_));
  EXPECT_THAT(points_, IsEmpty());
  EXPECT_FALSE(dut_.Forget({1, 2}, points_));
}

TEST_F(PointBookTest, WhatHadToGoHasNoNumberLeft) {
  for (int i = 0; i <= static_cast<int>(kMostPoints); ++i) dut_.Take({1, i}, At(i, 1000 + i), points_);
  ASSERT_THAT(points_, SizeIs(kMostPoints));
  EXPECT_FALSE(dut_.Forget({1, 0}, points_));
  dut_.Take({1, 0}, At(0, 5000), points_);
  EXPECT_FALSE(dut_.Forget({1, 1}, points_));
  EXPECT_TRUE(dut_.Forget({1, 0}, points_));
}

}  // namespace
}  // namespace priamos::planner
