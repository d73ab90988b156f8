#include "common/warning_limit.hpp"

#include <gmock/gmock.h>

namespace priamos {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Time At(double s) {
  return FromUtime(1'000'000'000) + FromSeconds(s);
}

TEST(WarningLimit, TheFirstIsToldAtOnceThenOneASecondWithThoseLeftOut) {
  WarningLimit dut;
  EXPECT_EQ(dut.Take("PATH", "path refused", At(0)), "path refused");
  for (int i = 1; i < 100; ++i) EXPECT_FALSE(dut.Take("PATH", "path refused", At(0.01 * i)));
  EXPECT_EQ(dut.Take("PATH", "path refused", At(1)), "path refused (PATH: 99 before it)");
  EXPECT_EQ(dut.Take("PATH", "path refused", At(9)), "path refused");
}

TEST(WarningLimit, AFloodThatHasEndedIsCountedToItsEnd) {
  WarningLimit dut;
  dut.Take("PATH", "path refused", At(0));
  EXPECT_THAT(dut.LeftOut(At(2)), IsEmpty());
  dut.Take("PATH", "path refused", At(2));
  dut.Take("PATH", "path refused", At(2.1));
  dut.Take("PATH", "another", At(2.2));
  EXPECT_THAT(dut.LeftOut(At(2.5)), IsEmpty()) << "one a second";
  EXPECT_THAT(dut.LeftOut(At(3)), ElementsAre("PATH: 2 more refused"));
  EXPECT_THAT(dut.LeftOut(At(9)), IsEmpty());
}

TEST(WarningLimit, OneTopicHidesNoOther) {
  WarningLimit dut;
  dut.Take("PATH", "path refused", At(0));
  dut.Take("PATH", "path refused", At(0));
  EXPECT_EQ(dut.Take("ESTOP", "re-arming refused", At(0)), "re-arming refused");
}

}  // namespace
}  // namespace priamos
