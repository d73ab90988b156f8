#include "head/core/calibration/resection/point_list.hpp"

#include <gmock/gmock.h>

namespace priamos::head {
namespace {

using testing::HasSubstr;

TEST(PointList, ReadsNumbersHoweverTheyAreSeparated) {
  const auto dut = ParsePointList("# X Y Z u v\n1 2 3 400.5 300\n\n0.1,-0.2;3e-1\t+7 8 # the last\r\n");
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->size(), 2u);
  EXPECT_EQ((*dut)[1].point_m, Eigen::Vector3d(0.1, -0.2, 0.3));
  EXPECT_EQ((*dut)[1].image_px, Eigen::Vector2d(7, 8));
}

TEST(PointList, NamesTheLineThatIsWrong) {
  EXPECT_THAT(ParsePointList("1 2 3 4 5\n1 2 3 4\n").reason(), HasSubstr("2: expected five numbers"));
  EXPECT_THAT(ParsePointList("1 2 3 4 5 6\n").reason(),
              HasSubstr("1: expected five numbers X Y Z u v, got 6"));
  EXPECT_THAT(ParsePointList("1 2 3 4 five\n").reason(), HasSubstr("\"five\""));
  EXPECT_THAT(ParsePointList("1 2 3 4 5x\n").reason(), HasSubstr("\"5x\""));
}

TEST(PointList, RefusesWhatIsNoNumber) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999", "0x10", "--1", "+"})
    EXPECT_FALSE(ParsePointList(std::string("1 2 3 4 ") + bad)) << bad;
}

TEST(PointList, RefusesAPointTwice) {
  EXPECT_THAT(ParsePointList("1 2 3 4 5\n1 2 3 9 9\n").reason(), HasSubstr("2: "));
}

TEST(PointList, NothingIsAnEmptyList) {
  const auto dut = ParsePointList("");
  ASSERT_TRUE(dut);
  EXPECT_TRUE(dut->empty());
}

}  // namespace
}  // namespace priamos::head
