#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "test/bus/radio/link_pair.hpp"

// Two ends that change from one key to the next while messages cross.

namespace priamos::bus::radio {
namespace {

using testing::Each;
using testing::IsEmpty;

constexpr LinkKey kNext{4, 5, 6}, kOther{7, 8, 9};

std::vector<std::vector<std::byte>> FramesOf(std::span<const std::byte> wire) {
  std::vector<std::vector<std::byte>> frames(1);
  for (const std::byte b : wire) {
    frames.back().push_back(b);
    if (b == kDelimiter) frames.emplace_back();
  }
  frames.pop_back();
  return frames;
}

struct Rekey : testing::Test {
  explicit Rekey(const LinkOptions& options = {}) : dut({}, 1, options) {}
  void Restart(LinkPair::End& end, std::optional<LinkKey> next_key) {
    end.link->Close();
    end.next_key = next_key;
    dut.Start(end);
  }
  KeyChange Of(const LinkPair::End& end) const { return end.link->Status(dut.now).key_change; }
  bool Done() const { return Of(dut.onboard) == KeyChange::kDone && Of(dut.offboard) == KeyChange::kDone; }
  /// Whether commands and events pass both ways now.
  bool Works() {
    dut.onboard.received.clear();
    dut.offboard.received.clear();
    for (int i = 0; i < 10; ++i) {
      if (i == 0) dut.onboard.link->Offer(kEventUp, Text("up"), dut.now);
      if (i == 0) dut.offboard.link->Offer(kEventDown, Text("down"), dut.now);
      dut.offboard.link->Offer(kDriveDown, Text("drive"), dut.now);
      dut.Run(0.1);
    }
    return dut.offboard.TextsOf(kEventUp).size() == 1 && dut.onboard.TextsOf(kEventDown).size() == 1 &&
           dut.onboard.TextsOf(kDriveDown).size() >= 5;
  }
  LinkPair dut;
};

TEST_F(Rekey, TheKeyChangesWhenBothEndsHaveTheNextOne) {
  dut.Run(1);
  Restart(dut.offboard, kNext);
  dut.Run(5);
  EXPECT_EQ(Of(dut.offboard), KeyChange::kWaiting);
  EXPECT_EQ(Of(dut.onboard), KeyChange::kOffered);
  EXPECT_TRUE(Works());
  Restart(dut.onboard, kNext);
  EXPECT_TRUE(dut.RunUntil(0.4, [this] { return Done(); }));
  EXPECT_TRUE(Works());
}

TEST_F(Rekey, TheKeyChangesUnderLoadWithoutAPauseOfCommands) {
  dut.Run(1);
  Restart(dut.offboard, kNext);
  dut.Run(2);
  std::size_t came = 0;
  Duration longest{};
  Time last = dut.now;
  dut.each_step = [&] {
    if (ToUtime(dut.now) % 50'000 == 0) dut.offboard.link->Offer(kDriveDown, Text("drive"), dut.now);
    if (ToUtime(dut.now) % 100'000 == 0) dut.onboard.link->Offer(kPoseUp, Text("0123456789"), dut.now);
    if (dut.onboard.received.size() == came) return;
    came = dut.onboard.received.size();
    longest = std::max(longest, dut.now - last);
    last = dut.now;
  };
  Restart(dut.onboard, kNext);
  dut.Run(3);
  EXPECT_TRUE(Done());
  EXPECT_GE(came, 50U);
  EXPECT_LE(longest, Duration(300'000)) << "the restart included";
  dut.each_step = nullptr;
}

TEST_F(Rekey, EventsThatWaitArriveOnceUnderAKeyThatWasReplacedByHand) {
  dut.Run(1);
  dut.lose_up = [](auto) { return true; };
  dut.onboard.link->Offer(kEventUp, Text("waits"), dut.now);
  dut.Run(1);
  dut.lose_up = nullptr;
  for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) {
    end->key = kNext;
    Restart(*end, {});
  }
  dut.Run(3);
  EXPECT_THAT(dut.offboard.TextsOf(kEventUp), testing::ElementsAre("waits"));
}

TEST_F(Rekey, AnEndThatHasFinishedWorksWithOneThatHasNot) {
  for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) Restart(*end, kNext);
  ASSERT_TRUE(dut.RunUntil(3, [this] { return Done(); }));
  dut.onboard.key = kNext;
  Restart(dut.onboard, {});
  const std::uint64_t hellos = dut.offboard.link->Status(dut.now).counters.hellos_sent;
  EXPECT_TRUE(Works());
  dut.offboard.key = kNext;
  Restart(dut.offboard, {});
  EXPECT_TRUE(Works());
  EXPECT_EQ(dut.offboard.link->Status(dut.now).counters.hellos_sent, 0U);
  EXPECT_LE(hellos, 4U);
}

TEST_F(Rekey, ARestartAfterwardsNeedsNoAgreement) {
  for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) Restart(*end, kNext);
  ASSERT_TRUE(dut.RunUntil(3, [this] { return Done(); }));
  dut.Run(1);
  for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) {
    dut.Start(*end);  // killed
    EXPECT_EQ(Of(*end), KeyChange::kDone);
    EXPECT_TRUE(Works());
    EXPECT_EQ(end->link->Status(dut.now).counters.hellos_sent, 0U);
  }
}

TEST_F(Rekey, AnEndThatFinishesTooEarlyReachesOneThatHasNotChanged) {
  dut.Run(1);
  Restart(dut.offboard, kNext);
  dut.onboard.key = kNext;
  Restart(dut.onboard, {});
  EXPECT_TRUE(dut.RunUntil(5, [this] { return Of(dut.offboard) == KeyChange::kDone; }));
  EXPECT_TRUE(Works());
}

TEST_F(Rekey, AnEndWithoutTheNextKeyGoesOnAsBefore) {
  Restart(dut.offboard, kNext);
  dut.Run(10);
  EXPECT_TRUE(Works());
  Restart(dut.offboard, {});
  EXPECT_TRUE(Works());
  EXPECT_EQ(Of(dut.offboard), KeyChange::kNone);
}

TEST_F(Rekey, DifferentNextKeysAreReportedAndChangeNothing) {
  Restart(dut.onboard, kOther);
  Restart(dut.offboard, kNext);
  dut.Run(1);
  const std::uint64_t hellos = dut.onboard.link->Status(dut.now).counters.hellos_sent;
  dut.Run(5);
  EXPECT_EQ(dut.onboard.link->Status(dut.now).counters.hellos_sent, hellos) << "nobody asks";
  EXPECT_EQ(Of(dut.onboard), KeyChange::kDiffers);
  EXPECT_EQ(Of(dut.offboard), KeyChange::kDiffers);
  EXPECT_TRUE(Works());
}

TEST_F(Rekey, NothingOfBeforeIsAcceptedAfterwards) {
  EXPECT_TRUE(Works());
  for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) Restart(*end, kNext);
  ASSERT_TRUE(dut.RunUntil(3, [this] { return Done(); }));
  dut.Run(1);
  const auto old_up = FramesOf(dut.wire_up), old_down = FramesOf(dut.wire_down);
  dut.onboard.received.clear();
  dut.offboard.received.clear();
  std::vector<Proof> proofs;
  for (const auto& frame : old_up) {
    dut.Run(0.1);
    proofs.push_back(
        dut.offboard.link->ReceiveFrame(std::span(frame).first(frame.size() - 1), dut.now, dut.now, false)
            .proof);
  }
  for (const auto& frame : old_down) {
    dut.Run(0.1);
    proofs.push_back(
        dut.onboard.link->ReceiveFrame(std::span(frame).first(frame.size() - 1), dut.now, dut.now, false)
            .proof);
  }
  EXPECT_GE(proofs.size(), 50U);
  EXPECT_THAT(proofs, Each(testing::Ne(Proof::kFresh)));
  EXPECT_THAT(dut.onboard.received, IsEmpty());
  EXPECT_THAT(dut.offboard.received, IsEmpty());
  EXPECT_TRUE(Works());
}

TEST_F(Rekey, AReplayedHelloUnderTheNextKeyDoesNotChangeAKey) {
  // An end without memory asks under both keys; the other end has no next one.
  Restart(dut.offboard, kNext);
  dut.offboard.store.Lose();
  dut.Start(dut.offboard);
  dut.wire_down.clear();
  dut.Run(1);
  const auto frames = FramesOf(dut.wire_down);
  // The operator takes the next key back there, and leaves it at the end on board.
  Restart(dut.offboard, {});
  Restart(dut.onboard, kNext);
  for (const auto& frame : frames) {
    dut.Run(0.3);
    dut.onboard.link->Receive(frame, dut.now);
  }
  EXPECT_EQ(Of(dut.onboard), KeyChange::kWaiting);
  EXPECT_TRUE(Works());
}

TEST_F(Rekey, AnEmptiedEndReachesOneThatHasChangedAndOneThatHasNot) {
  for (const bool changed : {false, true}) {
    for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) {
      end->store.Lose();
      Restart(*end, {});
      end->store.Lose();
      dut.Start(*end);
    }
    dut.Run(1);
    Restart(dut.offboard, kNext);
    if (changed) {
      Restart(dut.onboard, kNext);
      ASSERT_TRUE(dut.RunUntil(3, [this] { return Done(); }));
    }
    dut.onboard.next_key = kNext;
    dut.onboard.store.Lose();
    dut.Start(dut.onboard);
    EXPECT_TRUE(dut.RunUntil(5, [this] { return Done(); })) << changed;
    EXPECT_TRUE(Works()) << changed;
  }
}

TEST_F(Rekey, AnEmptiedEndReachesOneThatHasNoNextKey) {
  dut.Run(1);
  dut.offboard.next_key = kNext;
  dut.offboard.store.Lose();
  dut.Start(dut.offboard);
  dut.Run(2);
  EXPECT_TRUE(Works());
}

TEST_F(Rekey, AnotherTableIsSeenUnderTheNextKeyToo) {
  for (LinkPair::End* end : {&dut.onboard, &dut.offboard}) Restart(*end, kNext);
  ASSERT_TRUE(dut.RunUntil(3, [this] { return Done(); }));
  dut.onboard.code_bytes = 8;
  Restart(dut.onboard, kNext);
  dut.Run(5);
  EXPECT_TRUE(dut.onboard.link->Status(dut.now).table_mismatch);
  EXPECT_EQ(dut.onboard.link->Status(dut.now).peer_code_bytes, 4U);
  dut.onboard.code_bytes = 4;
  Restart(dut.onboard, kNext);
  dut.Run(3);
  EXPECT_FALSE(dut.onboard.link->Status(dut.now).table_mismatch);
  EXPECT_TRUE(Works());
}

struct RekeyInTurns : Rekey {
  RekeyInTurns() : Rekey({.half_duplex = {.turn = Duration(400'000), .turnaround = Duration(20'000)}}) {}
};

TEST_F(RekeyInTurns, TheKeyChangesToo) {
  dut.Run(3);
  Restart(dut.offboard, kNext);
  dut.Run(3);
  Restart(dut.onboard, kNext);
  EXPECT_TRUE(dut.RunUntil(10, [this] { return Done(); }));
  dut.Run(3);
  dut.onboard.link->Offer(kEventUp, Text("up"), dut.now);
  dut.offboard.link->Offer(kEventDown, Text("down"), dut.now);
  dut.Run(5);
  EXPECT_EQ(dut.offboard.TextsOf(kEventUp).size(), 1U);
  EXPECT_EQ(dut.onboard.TextsOf(kEventDown).size(), 1U);
}

}  // namespace
}  // namespace priamos::bus::radio
