#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test/bus/radio/measurement/numbered_message.hpp"

// Recorded hellos, played again at both ends: nothing may follow from one that is not proven fresh.

namespace priamos::bus::radio {
namespace {

constexpr HalfDuplex kTurns{.turn = Duration(400'000), .turnaround = Duration(20'000)};

using Frames = std::vector<std::vector<std::byte>>;

Frames HellosOf(const std::vector<std::byte>& wire) {
  Frames hellos;
  for (const auto& frame : FramesOf(wire))
    if (frame.size() >= kHelloFrameBytes && frame.size() <= kHelloFrameBytes + 1) hellos.push_back(frame);
  return hellos;
}

/// Two ends, of which an attacker has recorded every hello so far.
struct HelloReplay : testing::Test {
  void Record() {
    up = HellosOf(dut->wire_up);
    down = HellosOf(dut->wire_down);
    ASSERT_FALSE(up.empty() || down.empty());
  }
  /// Both ends begin a new session, without a memory of the old one.
  void BeginAnew() {
    for (LinkPair::End* end : {&dut->onboard, &dut->offboard}) {
      end->store.Lose();
      dut->Start(*end);
    }
    dut->Run(2);
  }
  /// Runs for ten seconds at full load, and plays a recorded hello at each end `replays_hz` times a second.
  /// Not into a frame: that would damage it, which is no matter of hellos.
  void Run(double replays_hz) {
    dut->onboard.received.clear();
    dut->offboard.received.clear();
    Time next = dut->now;
    dut->each_step = [&] {
      Watch();
      Load();
      if (replays_hz <= 0 || dut->now < next || !Quiet()) return;
      next += FromSeconds(1 / replays_hz);
      ++played;
      dut->offboard.link->Receive(up[static_cast<std::size_t>(played) % up.size()], dut->now);
      dut->onboard.link->Receive(down[static_cast<std::size_t>(played) % down.size()], dut->now);
      Watch();
    };
    dut->Run(10);
    dut->each_step = nullptr;
  }
  void Watch() {
    for (const LinkPair::End* end : {&dut->onboard, &dut->offboard})
      mismatches += end->link->Status(dut->now).table_mismatch ? 1 : 0;
  }
  void Load() {
    if (ToUtime(dut->now) % 100'000 != 0) return;
    dut->onboard.link->Offer(kPoseUp, Text("0123456789"), dut->now);
    dut->offboard.link->Offer(kDriveDown, Text("abcde"), dut->now);
  }
  /// Whether no frame is under way: bytes are written up to three milliseconds ahead of the line.
  bool Quiet() {
    const std::size_t written = dut->wire_up.size() + dut->wire_down.size();
    if (written != written_ || dut->wire_up.back() != kDelimiter || dut->wire_down.back() != kDelimiter)
      quiet_since_ = dut->now + Duration(6000);
    written_ = written;
    return dut->now > quiet_since_;
  }
  /// Messages that both ends got.
  std::size_t Delivered() const {
    return dut->onboard.TextsOf(kDriveDown).size() + dut->offboard.TextsOf(kPoseUp).size();
  }

  std::unique_ptr<LinkPair> dut = std::make_unique<LinkPair>(LineConfig{.latency_s = 0});
  Frames up, down;
  int mismatches = 0, played = 0;

 private:
  std::size_t written_ = 0;
  Time quiet_since_{};
};

TEST_F(HelloReplay, OfAnotherTableInAnEarlierSessionIsNoMismatch) {
  dut->offboard.channels[kPoseUp].fixed_bits = 88;
  dut->Start(dut->offboard);
  dut->Run(2);
  ASSERT_TRUE(dut->onboard.link->Status(dut->now).table_mismatch);
  Record();
  dut->offboard.channels = TestChannels();
  BeginAnew();
  Run(20);
  EXPECT_GT(played, 100);
  EXPECT_EQ(mismatches, 0);
}

TEST_F(HelloReplay, OfAnotherTableInTheSameSessionIsNoMismatch) {
  dut->offboard.channels[kPoseUp].fixed_bits = 88;
  dut->Start(dut->offboard);
  dut->Run(2);
  Record();
  dut->offboard.channels = TestChannels();
  dut->Start(dut->offboard);  // the onboard end goes on
  dut->Run(2);
  Run(20);
  EXPECT_GT(played, 100);
  EXPECT_EQ(mismatches, 0);
}

TEST_F(HelloReplay, CostsAlmostNothing) {
  dut->Run(2);
  for (const bool same_session : {true, false}) {
    Run(0);
    const std::size_t undisturbed = Delivered();
    Record();
    if (!same_session) BeginAnew();
    Run(20);
    EXPECT_GE(Delivered(), undisturbed * 98 / 100) << same_session;
  }
}

TEST_F(HelloReplay, DoesNotSlowTheTurnsOfAHalfDuplexLink) {
  for (const bool same_session : {true, false}) {
    dut = std::make_unique<LinkPair>(LineConfig{.latency_s = 0, .half_duplex = true}, 1,
                                     LinkOptions{.half_duplex = kTurns});
    dut->Run(2);
    Run(0);
    const std::size_t undisturbed = Delivered();
    Record();
    if (!same_session) BeginAnew();
    const std::uint64_t missed = dut->offboard.link->Status(dut->now).counters.frames_missed;
    Run(20);
    EXPECT_GE(Delivered(), undisturbed * 95 / 100) << same_session;
    EXPECT_EQ(dut->offboard.link->Status(dut->now).counters.frames_missed, missed);  // nobody talked into it
  }
}

TEST_F(HelloReplay, DoesNotKeepANewEndFromAgreeing) {
  dut->Run(2);
  Record();
  dut->each_step = [&] {
    if (ToUtime(dut->now) % 4'000 != 0 || !Quiet()) return;
    for (const auto& hello : up) dut->offboard.link->Receive(hello, dut->now);
  };
  for (int i = 0; i < 10; ++i) {
    dut->Run(3);
    dut->onboard.store.Lose();
    dut->Start(dut->onboard);
    EXPECT_TRUE(dut->RunUntil(2, [&] { return dut->onboard.link->Status(dut->now).agreed; })) << i;
  }
}

/// Ends that lose their memory again and again leave a recording of many lives: more than an end can
/// remember.
TEST_F(HelloReplay, OfManyLivesAtBothEndsDoesNotKeepANewEndFromAgreeing) {
  for (int life = 0; life < 300; ++life) {
    for (LinkPair::End* end : {&dut->onboard, &dut->offboard}) {
      end->store.Lose();
      dut->Start(*end);
    }
    dut->Run(0.7);
  }
  Record();
  std::size_t next = 0;
  dut->each_step = [&] {
    Load();
    if (ToUtime(dut->now) % 10'000 != 0 || !Quiet()) return;
    next += 7;
    dut->offboard.link->Receive(up[next % up.size()], dut->now);
    dut->onboard.link->Receive(down[next % down.size()], dut->now);
  };
  for (int i = 0; i < 20; ++i) {
    dut->Run(3);
    LinkPair::End& restarted = i % 2 == 0 ? dut->onboard : dut->offboard;
    restarted.store.Lose();
    dut->Start(restarted);
    const auto agreed = [&] {
      return dut->onboard.link->Status(dut->now).agreed && dut->offboard.link->Status(dut->now).agreed;
    };
    EXPECT_TRUE(dut->RunUntil(2, agreed)) << i;
  }
}

}  // namespace
}  // namespace priamos::bus::radio
