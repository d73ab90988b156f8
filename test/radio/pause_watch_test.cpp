#include "radio/pause_watch.hpp"

#include <gtest/gtest.h>

namespace priamos::radio {
namespace {

constexpr Duration kTick{1000};
constexpr Time kStart{Duration(5'000'000)};

Time After(Duration d) {
  return kStart + d;
}

struct PauseWatchTest : testing::Test {
  PauseWatchTest() { RunTo(Duration(100'000)); }
  void RunTo(Duration until) {
    for (; at < until; at += kTick) dut.Tick(After(at));
  }
  Duration at{kTick};
  PauseWatch dut{kTick, kStart};
};

TEST_F(PauseWatchTest, MessagesOfABusyProcessCameWhenTheyAreRead) {
  EXPECT_EQ(dut.CameAt(After(at)), After(at));
  EXPECT_EQ(dut.CameAt(After(at + 2 * kTick)), After(at + 2 * kTick)) << "a tick that comes late";
}

TEST_F(PauseWatchTest, MessagesAfterAPauseMayBeAsOldAsIt) {
  const Time before = After(at - kTick);
  at += FromSeconds(2);
  EXPECT_EQ(dut.CameAt(After(at)), before) << "read before the first tick";
  dut.Tick(After(at));
  EXPECT_EQ(dut.CameAt(After(at)), before) << "or after it";
  EXPECT_EQ(dut.CameAt(After(at + 3 * kTick)), before) << "the queue may be long";
}

TEST_F(PauseWatchTest, SoonAfterAPauseAllIsAsBefore) {
  at += FromSeconds(2);
  RunTo(at + Duration(50'000));
  EXPECT_EQ(dut.CameAt(After(at)), After(at));
}

}  // namespace
}  // namespace priamos::radio
