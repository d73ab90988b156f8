#include "radio/newcomers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace priamos::radio {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const Time kStart = FromUtime(1'000'000'000);
Time After(double s) {
  return kStart + FromSeconds(s);
}

TEST(Newcomers, ThereIsRoomForFewAndTheOldestSilentOneLeaves) {
  Newcomers dut;
  for (int id = 0; id < static_cast<int>(Newcomers::kMost); ++id)
    EXPECT_FALSE(dut.Admit(id, After(0.001 * id)));
  dut.OnBytes(0, 10);
  EXPECT_EQ(dut.Admit(1000, After(1)), 1);
  EXPECT_EQ(dut.size(), Newcomers::kMost);
}

TEST(Newcomers, WhoCarriedAFrameOfTheOtherEndLeavesLast) {
  Newcomers dut;
  for (int id = 0; id < static_cast<int>(Newcomers::kMost); ++id) {
    dut.Admit(id, After(0.001 * id));
    dut.OnBytes(id, 10);
  }
  dut.OnGenuine(0);
  EXPECT_EQ(dut.Admit(1000, After(1)), 1);
  EXPECT_THAT(dut.Genuine(), ElementsAre(0));
}

/// Where it was closed for others after 0.6 s, the other end came back only after several attempts.
TEST(Newcomers, WhoWaitsKeepsItsPlaceBesideFiftyTalkativeConnectionsPerSecond) {
  Newcomers dut;
  dut.Admit(0, kStart);
  dut.OnBytes(0, 10);
  for (int id = 1; id < 3 * 50; ++id) {
    const Time now = After(id / 50.0);
    for (const int over : dut.Expired(now)) dut.Remove(over);
    EXPECT_FALSE(dut.Admit(id, now)) << id;
    dut.OnBytes(id, 10);
  }
  EXPECT_TRUE(dut.OnBytes(0, 10));
}

TEST(Newcomers, TimeAndBytesAreBounded) {
  Newcomers dut;
  dut.Admit(1, kStart);
  dut.Admit(2, After(1));
  EXPECT_THAT(dut.Expired(After(3)), IsEmpty());
  EXPECT_THAT(dut.Expired(After(3.1)), ElementsAre(1));
  EXPECT_TRUE(dut.OnBytes(2, Newcomers::kMostBytes));
  EXPECT_FALSE(dut.OnBytes(2, 1));
  dut.Remove(2);
  EXPECT_FALSE(dut.OnBytes(2, 1));
}

}  // namespace
}  // namespace priamos::radio
