#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "test/bus/radio/measurement/numbered_message.hpp"

// No command is delivered when it is older than its time-to-live, and none seems younger than it is, whatever
// the line does.

namespace priamos::bus::radio {
namespace {

const Duration kTtl = TestChannels()[kDriveDown].ttl;

/// A step, a ramp or a stall of one direction or both.
LineDelay RandomDelay(Rng& rng, double seconds) {
  LineDelay d;
  d.way = std::array<const char*, 3>{"both", "a_to_b", "b_to_a"}[rng.Below(3)];
  d.from_s = rng.Uniform(0, seconds);
  d.to_s = d.from_s + rng.Uniform(0.05, 2);
  const double most_s = rng.Chance(0.5) ? 0.2 : 1.5;
  const auto kind = rng.Below(3);
  d.first_s = kind == 2 ? d.to_s - d.from_s : rng.Uniform(0, most_s);
  d.last_s = kind == 0 ? d.first_s : kind == 1 ? rng.Uniform(0, most_s) : 0;
  return d;
}

LineConfig RandomLine(Rng& rng, double seconds) {
  LineConfig line{.latency_s = rng.Uniform(0, 0.08)};
  if (rng.Chance(0.5)) line.jitter_s = rng.Uniform(0, 0.1);
  if (rng.Chance(0.3)) line.bit_error_rate = 1e-4;
  if (rng.Chance(0.3)) line.duplicate_probability = 1e-3;
  for (auto n = rng.Below(6); n > 0; --n) line.delays.push_back(RandomDelay(rng, seconds));
  return line;
}

/// Drive commands twenty times a second among other messages, and how old they are when they come.
class DriveByRadio {
 public:
  explicit DriveByRadio(const LineConfig& line, std::uint64_t seed = 1)
      : pair(line, seed), rng_(Rng::Stream(seed, "traffic")) {
    pair.each_step = [this] { Step(); };
  }

  LinkPair pair;
  std::size_t offered = 0;
  std::size_t delivered = 0;
  std::size_t too_old = 0;
  std::size_t too_young = 0;  ///< their stamp is after their offer
  Duration oldest{0};
  Time last_delivered{};

 private:
  void Step() {
    if (ToUtime(pair.now) % 50'000 == 0) {
      offered_[static_cast<std::uint32_t>(offered)] = pair.now;
      pair.offboard.link->Offer(kDriveDown, NumberedMessage(static_cast<std::uint32_t>(offered++), 5),
                                pair.now);
    }
    if (rng_.Chance(0.008)) pair.onboard.link->Offer(kPoseUp, Text("0123456789"), pair.now);
    if (rng_.Chance(0.0005)) pair.onboard.link->Offer(kEventUp, Text(std::string(60, 'u')), pair.now);
    if (rng_.Chance(0.0005)) pair.offboard.link->Offer(kEventDown, Text(std::string(60, 'd')), pair.now);
    for (const LinkPair::Received& r : pair.onboard.received)
      if (r.delivery.channel == kDriveDown) Take(r);
    pair.onboard.received.clear();
    pair.offboard.received.clear();
  }
  void Take(const LinkPair::Received& r) {
    const Time at = offered_.at(NumberOf(r.delivery.packed));
    ++delivered;
    too_old += r.at - at > kTtl;
    too_young += r.delivery.packed_at > at;
    oldest = std::max<Duration>(oldest, r.at - at);
    last_delivered = r.at;
  }

  Rng rng_;
  std::map<std::uint32_t, Time> offered_;
};

TEST(CommandFreshness, HoldsOnAnyLine) {
  std::size_t delivered = 0;
  Duration oldest{0};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng = Rng::Stream(seed, "line");
    DriveByRadio dut(RandomLine(rng, 5), seed);
    const double loss = rng.Chance(0.5) ? rng.Uniform(0, 0.4) : 0;
    dut.pair.lose_up = dut.pair.lose_down = [&](std::span<const std::byte>) { return rng.Chance(loss); };
    dut.pair.Run(6);
    EXPECT_EQ(dut.too_old, 0U) << "seed " << seed;
    EXPECT_EQ(dut.too_young, 0U) << "seed " << seed;
    delivered += dut.delivered;
    oldest = std::max(oldest, dut.oldest);
  }
  EXPECT_GT(delivered, 2000U);
  EXPECT_GT(oldest, kTtl * 3 / 4);  // the law is put to the test
}

/// A bus that keeps commands, hands some on before those that were made earlier, and senders whose clocks are
/// wrong: what is obeyed is no older than its time-to-live, counted from its making, and in the order made.
TEST(CommandFreshness, HoldsForCommandsThatWereLateOnTheirBus) {
  std::size_t delivered = 0, expired = 0;
  Duration oldest{0};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rng rng = Rng::Stream(seed, "bus");
    LinkPair pair(rng.Chance(0.5) ? LineConfig{} : RandomLine(rng, 5), seed);
    const double late = rng.Chance(0.5) ? 0.3 : 1, most_s = rng.Uniform(0.02, 0.5);
    std::vector<Time> made_at;
    Time newest{};
    pair.each_step = [&] {
      if (ToUtime(pair.now) % 20'000 == 0) {
        const Duration lag = FromSeconds(rng.Chance(late) ? rng.Uniform(-0.1, most_s) : 0);
        pair.offboard.link->Offer(kDriveDown, NumberedMessage(static_cast<std::uint32_t>(made_at.size()), 5),
                                  pair.now, {}, pair.now - lag);
        made_at.push_back(std::min(pair.now, pair.now - lag));
      }
      for (const LinkPair::Received& r : pair.onboard.received) {
        const Time made = made_at.at(NumberOf(r.delivery.packed));
        EXPECT_LE(r.at - made, kTtl) << "seed " << seed;
        EXPECT_LE(r.delivery.packed_at, made) << "seed " << seed;
        EXPECT_GE(made, newest - SendQueue::kSameMoment) << "seed " << seed;
        newest = std::max(newest, made);
        oldest = std::max<Duration>(oldest, r.at - made);
        ++delivered;
      }
      pair.onboard.received.clear();
    };
    pair.Run(5);
    expired += pair.offboard.link->sent(kDriveDown).expired;
  }
  EXPECT_GT(delivered, 1000U);
  EXPECT_GT(expired, 1000U);
  EXPECT_GT(oldest, kTtl * 3 / 4);
}

TEST(CommandFreshness, HoldsWhenAnEndStartsAnew) {
  std::size_t delivered = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng = Rng::Stream(seed, "line");
    DriveByRadio dut(RandomLine(rng, 5), seed);
    for (int i = 0; i < 5; ++i) {
      dut.pair.Run(rng.Uniform(0.3, 1.5));
      LinkPair::End& end = rng.Chance(0.5) ? dut.pair.onboard : dut.pair.offboard;
      if (rng.Chance(0.3)) end.store.Lose();
      dut.pair.Start(end);
    }
    dut.pair.Run(1);
    EXPECT_EQ(dut.too_old + dut.too_young, 0U) << "seed " << seed;
    delivered += dut.delivered;
  }
  EXPECT_GT(delivered, 500U);
}

TEST(CommandFreshness, ADirectionThatHoldsEverythingDeliversNothingUntilItLetsGo) {
  for (const char* way : {"a_to_b", "b_to_a", "both"}) {
    LineConfig line;
    line.delays = {{way, 3, 8, 0.8, 0.8}};
    DriveByRadio dut(line);
    dut.pair.Run(3.4);  // what went before the step has come
    const std::size_t before = dut.delivered;
    EXPECT_GT(before, 50U);
    dut.pair.Run(4.5);
    EXPECT_EQ(dut.delivered, before) << way;
    dut.pair.Run(3.1);
    EXPECT_GT(dut.delivered, before + 30) << way;
    EXPECT_EQ(dut.too_old + dut.too_young, 0U) << way;
  }
}

TEST(CommandFreshness, ASlowLineStaysAliveForEverythingElse) {
  DriveByRadio dut(LineConfig{.latency_s = 2.5});
  int stops = 0;
  dut.pair.Run(30);
  EXPECT_EQ(dut.delivered, 0U);
  dut.pair.each_step = [&] {
    for (const LinkPair::Received& r : dut.pair.onboard.received) stops += r.delivery.channel == kStopDown;
    dut.pair.onboard.received.clear();
  };
  for (int i = 0; i < 10; ++i) {
    dut.pair.offboard.link->Offer(kStopDown, Text("!"), dut.pair.now);
    dut.pair.Run(3);
  }
  EXPECT_GE(stops, 9);  // the last one may be on its way
  EXPECT_FALSE(dut.pair.onboard.link->Status(dut.pair.now).alarm);
}

TEST(CommandFreshness, WhatIsUrgentPassesALineThatIsDeadInTheOtherDirection) {
  // 256 frames of the robot go by unheard: an echo of one byte would name another one.
  for (const double dead_s : {0.5, 2.0, 4.0, 10.0, 30.0}) {
    LinkPair dut;
    int number = 0;
    dut.each_step = [&] {
      dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
      KeepEventsWaiting(dut, dut.onboard, kEventUp, 1, number);
    };
    dut.Run(2);
    dut.lose_up = [](std::span<const std::byte>) { return true; };
    dut.Run(dead_s);
    dut.offboard.link->Offer(kStopDown, Text("!"), dut.now);
    dut.Run(0.05);
    EXPECT_EQ(dut.onboard.TextsOf(kStopDown).size(), 1U) << dead_s;
  }
}

TEST(CommandFreshness, AnEndThatStartedAnewObeysAgainWithinAQuarterSecond) {
  for (const bool robot : {true, false}) {
    DriveByRadio dut(LineConfig{.latency_s = 0.01});
    dut.pair.Run(2);
    dut.pair.Start(robot ? dut.pair.onboard : dut.pair.offboard);
    const Time started = dut.pair.now;
    EXPECT_TRUE(dut.pair.RunUntil(0.6, [&] { return dut.last_delivered > started + FromSeconds(0.05); }));
  }
}

}  // namespace
}  // namespace priamos::bus::radio
