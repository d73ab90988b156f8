#include "common/robot/sequence_number.hpp"

#include <gtest/gtest.h>

namespace priamos {
namespace {

TEST(IsAfter, LessThanHalfARoundAheadIsAfter) {
  EXPECT_TRUE(IsAfter(8, 7));
  EXPECT_TRUE(IsAfter(32774, 7));
  EXPECT_FALSE(IsAfter(7, 7));
  EXPECT_FALSE(IsAfter(7, 8));
  EXPECT_FALSE(IsAfter(32776, 7));
}

TEST(IsAfter, NumbersWrap) {
  EXPECT_TRUE(IsAfter(0, 65535));
  EXPECT_TRUE(IsAfter(5, 65530));
  EXPECT_FALSE(IsAfter(65535, 0));
}

}  // namespace
}  // namespace priamos
