#include "head/core/motion/glance_rhythm.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

TEST(GlanceRhythm, OneGlanceAtATimeAndAPauseBetweenThem) {
  GlanceRhythm dut(0.5, 2);
  EXPECT_FALSE(dut.Step(false, false, false, At(0))) << "nobody wants one";
  EXPECT_TRUE(dut.Step(false, false, true, At(0.1)));
  EXPECT_FALSE(dut.Step(false, true, true, At(0.5)));
  EXPECT_FALSE(dut.Step(false, false, true, At(0.9)));
  EXPECT_TRUE(dut.Step(false, false, true, At(1.0)));
}

TEST(GlanceRhythm, WhoNeedsTheHeadHasItForAWhile) {
  GlanceRhythm dut(0.5, 2);
  EXPECT_FALSE(dut.Step(true, false, true, At(0)));
  EXPECT_FALSE(dut.Step(false, false, true, At(1.9)));
  EXPECT_TRUE(dut.Step(false, false, true, At(2.1)));
}

}  // namespace
}  // namespace priamos::head
