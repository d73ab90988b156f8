#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "test/bus/radio/measurement/numbered_message.hpp"

// What the link must hold when it is busy, disturbed or attacked. Simulated time.

namespace priamos::bus::radio {
namespace {

using testing::Each;
using testing::Le;

TEST(LinkStress, InStepAgainWithinOneFrame) {
  LinkPair dut(LineConfig{.latency_s = 0});
  dut.Run(1);
  Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<std::byte> noise(1 + rng.Below(200));
    for (std::byte& b : noise) b = static_cast<std::byte>(rng.Below(256));
    dut.offboard.link->Receive(noise, dut.now);
    dut.offboard.received.clear();
    // The first one may be glued to the noise, the second one is through.
    for (int k = 0; k < 2; ++k) {
      dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
      dut.Run(0.12);
    }
    ASSERT_FALSE(dut.offboard.received.empty()) << i;
  }
}

TEST(LinkStress, StopPassesEverythingWithinTwentyMilliseconds) {
  LinkPair dut(LineConfig{.latency_s = 0});
  dut.Run(1);
  Rng rng(1);
  int number = 0;
  std::vector<double> latencies;
  std::optional<Time> offered;
  Time next = dut.now;
  dut.each_step = [&] {
    KeepEventsWaiting(dut, dut.offboard, kEventDown, 300, number);
    dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
    if (!dut.onboard.TextsOf(kStopDown).empty() && offered) {
      latencies.push_back(Seconds(dut.now - *offered));
      offered.reset();
      next = dut.now + FromSeconds(rng.Uniform(0.05, 0.3));
    }
    dut.onboard.received.clear();
    if (!offered && dut.now >= next) {
      dut.offboard.link->Offer(kStopDown, Text("!"), dut.now);
      offered = dut.now;
    }
  };
  dut.Run(250);
  ASSERT_GT(latencies.size(), 1000U);
  EXPECT_THAT(latencies, Each(Le(0.020)));
  RecordProperty("worst_s", std::to_string(*std::max_element(latencies.begin(), latencies.end())));
}

TEST(LinkStress, ReplayedHellosDoNotBreakARunningLink) {
  LinkPair dut;
  dut.Run(2);
  const auto old_up = FramesOf(dut.wire_up);
  Rng rng(2);
  dut.each_step = [&] {
    dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
    if (ToUtime(dut.now) % 50'000 != 0) return;
    for (const auto& frame : old_up)
      if (frame.size() >= kHelloFrameBytes && frame.size() <= kHelloFrameBytes + 1)
        dut.offboard.link->Receive(frame, dut.now);
  };
  dut.offboard.received.clear();
  dut.Run(20);
  // Every replayed hello may spoil the frame it falls into, and costs an answer now and then.
  EXPECT_GT(dut.offboard.TextsOf(kPoseUp).size(), 60U);
  EXPECT_LT(dut.offboard.link->Status(dut.now).counters.hellos_sent, 60U);
}

}  // namespace
}  // namespace priamos::bus::radio
