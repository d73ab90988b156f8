#include "head/core/calibration/rig/progress_bar.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

TEST(ProgressBar, ShowsShareAndTimeLeft) {
  EXPECT_EQ(ProgressBar(5, 20, 20.5), "[#####...............]  25 %, 1:02 left");
}

TEST(ProgressBar, PromisesNothingBeforeTheFirstPart) {
  EXPECT_EQ(ProgressBar(0, 20, 3), "[....................]   0 %");
}

TEST(ProgressBar, EndsFull) {
  EXPECT_EQ(ProgressBar(7, 7, 3), "[####################] 100 %");
}

TEST(ProgressBar, SurvivesNonsense) {
  EXPECT_EQ(ProgressBar(0, 0, 0), "[####################] 100 %");
  EXPECT_EQ(ProgressBar(9, 7, -1), "[####################] 100 %");
}

}  // namespace
}  // namespace priamos::head
