#include "robot/core/motion/meeting_stop.hpp"

#include <gtest/gtest.h>

namespace priamos::robot {
namespace {

constexpr Time At(double seconds) {
  return FromUtime(1'000'000'000 + static_cast<std::int64_t>(seconds * 1e6));
}

TEST(MeetingStop, ItStandsAsLongAsSomebodyIsAboutToMeetIt) {
  MeetingStop dut{MeetingStopConfig{}};
  EXPECT_FALSE(dut.Stands(false, At(0)));
  EXPECT_TRUE(dut.Stands(true, At(0.1)));
  EXPECT_TRUE(dut.Stands(true, At(1)));
  EXPECT_FALSE(dut.Stands(false, At(1.1)));
  EXPECT_TRUE(dut.Stands(true, At(4.5))) << "its patience begins anew";
}

TEST(MeetingStop, NotForEver) {
  const MeetingStopConfig config;
  MeetingStop dut(config);
  double stood_s = 0;
  for (double t = 0; t < 60; t += 0.1) stood_s += dut.Stands(true, At(t)) ? 0.1 : 0;
  EXPECT_NEAR(stood_s, 60 * config.patience_s / (config.patience_s + config.not_again_s), 2.5);
}

}  // namespace
}  // namespace priamos::robot
