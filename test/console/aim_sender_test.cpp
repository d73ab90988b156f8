#include "console/aim_sender.hpp"

#include <gtest/gtest.h>

namespace priamos::console {
namespace {

using std::chrono::milliseconds;

TEST(AimSender, SaysAnAimThreeTimes) {
  AimSender dut;
  const Time start = FromUtime(1'000'000);
  EXPECT_FALSE(dut.Step(start));
  head_aim_t aim{};
  aim.pan_rad = 0.5;
  dut.Give(aim);
  int sent = 0;
  for (int ms = 0; ms < 5000; ms += 50) {
    const auto message = dut.Step(start + milliseconds(ms));
    if (!message) continue;
    EXPECT_EQ(message->pan_rad, 0.5);
    EXPECT_EQ(ms, sent * 600);
    ++sent;
  }
  EXPECT_EQ(sent, 3);
}

TEST(AimSender, ANewAimTakesThePlaceOfTheOneBefore) {
  AimSender dut;
  const Time start = FromUtime(1'000'000);
  dut.Give({});
  dut.Step(start);
  head_aim_t aim{};
  aim.pan_rad = 1;
  dut.Give(aim);
  EXPECT_EQ(dut.Step(start + milliseconds(1))->pan_rad, 1) << "at once";
}

}  // namespace
}  // namespace priamos::console
