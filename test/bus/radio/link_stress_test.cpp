#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "bus/radio/budget.hpp"
#include "link_pair.hpp"

// What the link must hold when it is overloaded, damaged, cut or attacked. Simulated time.

namespace priamos::bus::radio {
namespace {

using testing::Each;
using testing::Le;

/// Keeps an outgoing event channel full.
void KeepFull(LinkPair& pair, LinkPair::End& end, std::size_t channel, std::size_t bytes, int& number) {
  while (end.link->waiting(channel) < 40) {
    std::string text = std::to_string(number++) + ":";
    text.resize(bytes, 'x');
    end.link->Offer(channel, Text(text), pair.now);
  }
}

double EventGoodput(double bit_error_rate, std::uint64_t seed, double seconds = 60) {
  LinkPair pair(LineConfig{.bit_error_rate = bit_error_rate}, seed);
  pair.RunUntil(30, [&] { return pair.onboard.link->Status(pair.now).up; });
  int number = 0;
  pair.each_step = [&] { KeepFull(pair, pair.onboard, kEventUp, 104, number); };
  pair.Run(seconds);
  const auto texts = pair.offboard.TextsOf(kEventUp);
  for (std::size_t i = 0; i < texts.size(); ++i)
    EXPECT_EQ(texts[i].substr(0, texts[i].find(':')), std::to_string(i));
  return 104 * static_cast<double>(texts.size()) / seconds;
}

TEST(LinkStress, SaturatedLineCarriesBundles) {
  LinkPair dut;
  int number = 0;
  dut.each_step = [&] {
    KeepFull(dut, dut.onboard, kEventUp, 104, number);
    dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
  };
  dut.Run(2);
  const LinkCounters before = dut.onboard.link->Status(dut.now).counters;
  dut.Run(60);
  const LinkCounters after = dut.onboard.link->Status(dut.now).counters;
  const auto bytes = static_cast<double>(after.bytes_sent - before.bytes_sent);
  EXPECT_GT(bytes / 60, 0.995 * 960);
  EXPECT_GT(static_cast<double>(after.bundle_bytes_sent - before.bundle_bytes_sent) / bytes, 0.93);
}

TEST(LinkStress, BitErrorsCostNoMoreThanTheyMust) {
  const double clean = EventGoodput(0, 1);
  RecordProperty("clean_bytes_per_s", std::to_string(clean));
  for (const auto& [rate, share] : std::map<double, double>{{1e-5, 0.95}, {1e-4, 0.80}, {1e-3, 0.25}}) {
    const double goodput = EventGoodput(rate, 2) / clean;
    RecordProperty("share_at_" + std::to_string(rate), std::to_string(goodput));
    EXPECT_GE(goodput, share) << rate;
  }
}

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
    KeepFull(dut, dut.offboard, kEventDown, 300, number);
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

TEST(LinkStress, ThreeTimesTheLineStarvesNobody) {
  LinkPair dut;
  // What the rates allow fits the line; offered are 100 Hz of each state and events without end.
  for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) {
    end->channels[kPoseUp].rate_hz = 5;  // a period longer than a frame
    end->channels[kEventUp].rate_hz = 1.2;
    end->channels[kEventUp].max_bits = 8 * 400;
    dut.Start(*end);
  }
  const Budget budget = ComputeBudget(dut.onboard.link->table(), dut.onboard.options);
  ASSERT_GT(budget.up.utilisation, 0.6);
  ASSERT_LT(budget.up.utilisation, 1.0);
  int number = 0;
  std::map<std::size_t, Duration> oldest;
  dut.Run(1);
  dut.each_step = [&] {
    KeepFull(dut, dut.onboard, kEventUp, 400, number);
    if (ToUtime(dut.now) % 10'000 == 0) {
      dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
      dut.onboard.link->Offer(kSlowUp, Text(std::string(100, 's')), dut.now);
    }
    oldest[kPoseUp] = std::max(oldest[kPoseUp], dut.onboard.link->OldestAge(kPoseUp, dut.now));
  };
  dut.offboard.received.clear();
  dut.Run(60);
  EXPECT_NEAR(static_cast<double>(dut.offboard.TextsOf(kPoseUp).size()), 300, 5);
  EXPECT_NEAR(static_cast<double>(dut.offboard.TextsOf(kSlowUp).size()), 60, 3);
  EXPECT_NEAR(static_cast<double>(dut.offboard.TextsOf(kEventUp).size()), 72, 3);
  EXPECT_LE(oldest[kPoseUp], TestChannels()[kPoseUp].ttl);
}

TEST(LinkStress, BlackoutsLoseNoEventAndReturnFresh) {
  LineConfig line;
  Rng rng(3);
  double t = 5;
  std::vector<LineCut> cuts;
  while (t < 300) {
    const double dark = rng.Uniform(1, 10);
    cuts.push_back({t, t + dark});
    t += dark + 1;  // up in windows of 1 s
  }
  line.cuts = cuts;
  LinkPair dut(line);
  const Time start = dut.now;
  std::vector<std::string> sent;
  std::size_t next_cut = 0;
  std::vector<double> freshness;
  std::optional<Time> returned;
  int drives = 0;
  dut.each_step = [&] {
    const double s = Seconds(dut.now - start);
    if (ToUtime(dut.now) % 20'000 == 0) {
      dut.onboard.link->Offer(kPoseUp, Text(std::to_string(ToUtime(dut.now)).substr(0, 10)), dut.now);
      dut.offboard.link->Offer(kDriveDown, Text("drive"), dut.now);
    }
    if (ToUtime(dut.now) % 2'000'000 == 0 && s < 280) {
      sent.push_back("event at " + std::to_string(s));
      dut.onboard.link->Offer(kEventUp, Text(sent.back()), dut.now);
    }
    if (next_cut < cuts.size() && s >= cuts[next_cut].to_s) {
      returned = dut.now;
      dut.offboard.received.erase(std::remove_if(dut.offboard.received.begin(), dut.offboard.received.end(),
                                                 [](const auto& r) { return r.delivery.channel == kPoseUp; }),
                                  dut.offboard.received.end());
      ++next_cut;
    }
    if (returned && !dut.offboard.TextsOf(kPoseUp).empty()) {
      freshness.push_back(Seconds(dut.now - *returned));
      returned.reset();
    }
    for (const auto& r : dut.onboard.received) {
      if (r.delivery.channel != kDriveDown) continue;
      EXPECT_GE(*r.delivery.valid_until, r.at);
      ++drives;
    }
    dut.onboard.received.clear();
  };
  dut.Run(330);
  EXPECT_EQ(dut.offboard.TextsOf(kEventUp), sent);
  EXPECT_THAT(freshness, Each(Le(0.3)));
  EXPECT_GT(freshness.size(), 30U);
  EXPECT_GT(drives, 300);
}

TEST(LinkStress, EventsOnceAndInOrderThroughLossAndRestarts) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    LinkPair dut({}, seed);
    Rng rng = Rng::Stream(seed, "faults");
    dut.lose_up = dut.lose_down = [&](std::span<const std::byte>) { return rng.Chance(0.3); };
    std::vector<std::string> sent;
    for (int i = 0; i < 60; ++i) {
      sent.push_back("event " + std::to_string(i) + std::string(rng.Below(150), '.'));
      dut.onboard.link->Offer(kEventUp, Text(sent.back()), dut.now);
      dut.Run(0.3);
      if (rng.Chance(0.15)) dut.Start(dut.onboard);
      if (rng.Chance(0.15)) dut.Start(dut.offboard);
    }
    dut.Run(20);
    EXPECT_EQ(dut.offboard.TextsOf(kEventUp), sent) << seed;
  }
}

/// Frames as they were on the line.
std::vector<std::vector<std::byte>> FramesOf(const std::vector<std::byte>& wire) {
  std::vector<std::vector<std::byte>> frames(1);
  for (const std::byte b : wire) {
    frames.back().push_back(b);
    if (b == kDelimiter) frames.emplace_back();
  }
  frames.pop_back();
  return frames;
}

TEST(LinkStress, NoForgedMutatedOrReplayedFrameIsAccepted) {
  LinkPair dut;
  dut.each_step = [&] {
    dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
    dut.offboard.link->Offer(kDriveDown, Text("abcde"), dut.now);
  };
  dut.Run(5);
  const auto same_boot = FramesOf(dut.wire_up), other_direction = FramesOf(dut.wire_down);
  for (const bool lost_state : {false, true}) {
    // A later boot of the receiver, with its memory and without.
    if (lost_state) {
      dut.offboard.store.Lose();
      dut.Start(dut.offboard);
      dut.Run(2);
    } else {
      dut.Start(dut.offboard);
    }
    Rng rng(9);
    LinkEndpoint& receiver = *dut.offboard.link;
    const std::uint64_t accepted = receiver.Status(dut.now).counters.frames_received;
    for (int i = 0; i < 150000; ++i) {
      dut.now += Duration(7300);  // as fast as the line could carry them
      const auto& from = rng.Chance(0.2) ? other_direction : same_boot;
      auto frame = from[rng.Below(from.size())];
      const int changes = static_cast<int>(rng.Below(4));  // 0: a plain replay
      for (int k = 0; k < changes; ++k)
        frame[rng.Below(frame.size())] = static_cast<std::byte>(rng.Below(256));
      frame.push_back(kDelimiter);
      EXPECT_TRUE(receiver.Receive(frame, dut.now).empty());
    }
    const LinkStatus status = receiver.Status(dut.now);
    EXPECT_EQ(status.counters.frames_received, accepted);
    EXPECT_TRUE(status.alarm);
  }
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
