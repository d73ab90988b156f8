#include "console/core/wanted_channels.hpp"

#include <gmock/gmock.h>

namespace priamos::console {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;
using Request = WantedChannels::Request;

class WantedChannelsTest : public testing::Test {
 protected:
  const Time start_{std::chrono::seconds(100)};
  WantedChannels dut_{{"SONAR_RANGES", "LANDMARK_VIEW"}};
};

TEST_F(WantedChannelsTest, FourPagesCostTheRadioWhatOneCosts) {
  for (ClientId page = 1; page <= 4; ++page) EXPECT_TRUE(dut_.Wish(page, "SONAR_RANGES", true));
  EXPECT_THAT(dut_.Step(start_), ElementsAre(Request{"SONAR_RANGES", WantedChannels::kHold_s}));
  EXPECT_THAT(dut_.Step(start_ + milliseconds(900)), IsEmpty());
  EXPECT_THAT(dut_.Step(start_ + milliseconds(1000)), testing::SizeIs(1)) << "repeated before it runs out";
}

TEST_F(WantedChannelsTest, WhatNobodyLooksAtIsGivenBackOnce) {
  dut_.Wish(1, "SONAR_RANGES", true);
  dut_.Wish(2, "SONAR_RANGES", true);
  dut_.Step(start_);
  dut_.Wish(1, "SONAR_RANGES", false);
  EXPECT_THAT(dut_.Step(start_ + milliseconds(10)), IsEmpty()) << "one still looks";
  dut_.Leave(2);
  EXPECT_THAT(dut_.Step(start_ + milliseconds(20)), ElementsAre(Request{"SONAR_RANGES", 0}));
  EXPECT_THAT(dut_.Step(start_ + milliseconds(2000)), IsEmpty());
}

TEST_F(WantedChannelsTest, ChannelsThatAreNotOfferedAreRefused) {
  EXPECT_FALSE(dut_.Wish(1, "POSE", true));
  EXPECT_THAT(dut_.Step(start_), IsEmpty());
}

}  // namespace
}  // namespace priamos::console
