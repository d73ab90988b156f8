#include "common/pilot/stop_keeper.hpp"

#include <gtest/gtest.h>

namespace priamos {
namespace {

using std::chrono::milliseconds;

TEST(StopKeeper, RepeatsAStopEverySecondUntilItIsLatched) {
  StopKeeper dut;
  Time now{std::chrono::seconds(100)};
  EXPECT_FALSE(dut.Step(false, now));
  dut.Order();
  int sent = 0;
  for (int i = 0; i < 250; ++i) sent += dut.Step(false, now += milliseconds(10));
  EXPECT_EQ(sent, 3);
  EXPECT_TRUE(dut.pending());
  EXPECT_FALSE(dut.Step(true, now));
  EXPECT_FALSE(dut.pending());
  EXPECT_FALSE(dut.Step(false, now + milliseconds(5000))) << "it was latched once";
}

TEST(StopKeeper, AnOrderIsSentThoughAStopIsLatchedAlready) {
  StopKeeper dut;
  dut.Order();
  EXPECT_TRUE(dut.Step(true, Time(milliseconds(5000)))) << "the robot may be re-armed in this moment";
  dut.Order();
  EXPECT_TRUE(dut.Step(true, Time(milliseconds(5010))));
}

TEST(StopKeeper, ForgetsWhenItIsRearmed) {
  StopKeeper dut;
  dut.Order();
  dut.Step(false, Time(milliseconds(5000)));
  dut.Forget();
  EXPECT_FALSE(dut.Step(false, Time(milliseconds(9000))));
}

}  // namespace
}  // namespace priamos
