#include "bus/radio/frame_scheduler.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bus/radio/frame/coded_block.hpp"
#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

constexpr std::uint64_t kEpoch = 5;
const LinkKey kKey{1, 2, 3};

/// The offboard end's scheduler with the parts around it, and nobody at the other end.
struct FrameSchedulerTest : testing::Test {
  explicit FrameSchedulerTest(LinkOptions o = {}) : options(o) {
    memory.ChangeEpoch(kEpoch, 1);
    receiver.SetEpoch(kEpoch, 0);
  }
  static NonceSource Nonces() {
    return [] { return std::uint64_t{7}; };
  }
  void Offer(std::size_t channel, const std::string& text) { outbox.Offer(channel, Text(text), now, ""); }
  /// One step after another, a millisecond each; everything that went on the line.
  std::vector<std::byte> Run(int ms) {
    std::vector<std::byte> wire;
    for (int i = 0; i < ms; ++i) {
      now += Duration(1000);
      const auto bytes = dut.Step({memory, receiver, peer, inbox, outbox}, now);
      wire.insert(wire.end(), bytes.begin(), bytes.end());
    }
    return wire;
  }
  /// Takes a frame of the other end, so that nobody asks for one.
  void Hear(std::uint64_t counter) {
    const FrameSealer sealer(FrameKeys(kKey), Direction::kUp, {table.hash(), false});
    for (const std::byte b : sealer.Seal(kEpoch, counter, CounterForm::kWhole, {})) receiver.Push(b, now);
    peer.acks.OnFrame(1);
  }
  static auto Frames(const std::vector<std::byte>& wire) {
    return std::count(wire.begin(), wire.end(), kDelimiter);
  }

  LinkOptions options;
  Time now = FromUtime(1'000'000'000);
  const ChannelTable table{TestChannels(), false};
  const FrameScope scope{table.hash(), false, 1};  // the direction down has a command
  MemoryStore store;
  LinkMemory memory{store, table, Nonces()};
  FrameReceiver receiver{FrameKeys(kKey), Direction::kUp, {table.hash(), false}, 960, FromSeconds(1.5), now};
  Peer peer{.handshake = Handshake(table.hash(), Nonces(), false, now)};
  MessageReceiver inbox{table};
  MessageSender outbox{table, Direction::kDown, FromSeconds(1), [](std::size_t, auto encoded, Time) {
                         return std::optional(Packed{{encoded.begin(), encoded.end()}, encoded.size() * 8});
                       }};
  FrameScheduler dut{table, FrameSealer(FrameKeys(kKey), Direction::kDown, scope), options, false, now};
};

TEST_F(FrameSchedulerTest, BreaksTheSilenceFourTimesASecond) {
  Hear(1);
  Run(100);
  const auto before = dut.counters().frames;
  Run(1000);
  EXPECT_NEAR(static_cast<double>(dut.counters().frames - before), 4, 1);
}

TEST_F(FrameSchedulerTest, UsesTheWholeLineAndNoMore) {
  Hear(1);
  for (int i = 0; i < 40; ++i) Offer(kEventDown, std::string(200, 'x'));
  EXPECT_NEAR(static_cast<double>(Run(1000).size()), 960, 5);
}

TEST_F(FrameSchedulerTest, CutsTheFrameForWhatIsUrgent) {
  Hear(1);
  Run(300);
  Offer(kEventDown, std::string(500, 'x'));
  Run(20);
  Offer(kStopDown, "!");
  const auto wire = Run(20);
  EXPECT_EQ(dut.counters().aborted, 1U);
  EXPECT_EQ(Frames(wire), 2);  // the cut, and the whole stop
}

TEST_F(FrameSchedulerTest, DoesNotCutWhatIsUrgentItself) {
  Hear(1);
  Run(300);
  Offer(kStopDown, "!");
  Run(3);
  Offer(kStopDown, "?");
  Run(60);
  EXPECT_EQ(dut.counters().aborted, 0U);
}

TEST_F(FrameSchedulerTest, WithoutAnEpochItOnlySaysHello) {
  memory.ChangeEpoch(0, 1);
  receiver.SetEpoch(0, 0);
  Offer(kStopDown, "!");
  Run(1000);
  EXPECT_EQ(dut.counters().frames, 0U);
  EXPECT_GE(peer.handshake.sent(), 2U);
}

TEST_F(FrameSchedulerTest, ACutFrameLeavesItsAcknowledgementDue) {
  Hear(1);
  Run(3);  // the acknowledgement is on its way
  EXPECT_FALSE(peer.acks.Due(now));
  Offer(kStopDown, "!");
  Run(1);
  EXPECT_EQ(dut.counters().aborted, 1U);
  EXPECT_TRUE(peer.acks.Due(now));
}

TEST_F(FrameSchedulerTest, CountersAreUsedOnceAlsoByFramesThatAreCut) {
  Hear(1);
  for (int i = 0; i < 20; ++i) {
    Offer(kEventDown, std::string(60, 'x'));
    Run(15);
    Offer(kStopDown, "!");
    Run(15);
  }
  EXPECT_GT(dut.counters().aborted, 2U);
  EXPECT_GE(memory.last_counter(), dut.counters().frames + dut.counters().aborted);
}

TEST_F(FrameSchedulerTest, CommandsWaitUntilTheOtherEndIsHeardAndHasConfirmedACounter) {
  const auto sent = [&] { return outbox.queue().counters(kDriveDown).sent; };
  Offer(kDriveDown, "abcde");
  Run(60);
  EXPECT_EQ(sent(), 0U) << "nothing to echo";
  Hear(1);
  Run(60);
  EXPECT_EQ(sent(), 0U) << "the whole counter has no echo";
  peer.sent.OnEpochChanged();  // both count from 1
  Run(60);
  EXPECT_EQ(sent(), 1U);
}

TEST_F(FrameSchedulerTest, AnEchoTooOldToBeCompletedIsNotSent) {
  peer.sent.OnEpochChanged();
  Hear(1);
  Run(1200);  // 128 of the smallest frames take 1.07 s
  Offer(kDriveDown, "abcde");
  Run(60);
  EXPECT_EQ(outbox.queue().counters(kDriveDown).sent, 0U);
  Hear(2);
  Run(60);
  EXPECT_EQ(outbox.queue().counters(kDriveDown).sent, 1U);
}

TEST_F(FrameSchedulerTest, AFrameCountsAsHandedOverWithTheLastByteOfItsContentUnlessItIsCut) {
  Hear(1);
  const Time begin = now;
  Run(1);
  ASSERT_EQ(memory.last_counter(), 1U);
  EXPECT_FALSE(peer.sent.HandedOver(1));
  Run(60);
  ASSERT_TRUE(peer.sent.HandedOver(1));
  EXPECT_GT(*peer.sent.HandedOver(1), begin + Duration(10'000));
  EXPECT_LT(*peer.sent.HandedOver(1), begin + Duration(30'000));
  Offer(kEventDown, std::string(500, 'x'));
  Run(5);
  Offer(kStopDown, "!");
  const std::uint64_t cut = memory.last_counter();
  Run(20);
  ASSERT_EQ(dut.counters().aborted, 1U);
  EXPECT_FALSE(peer.sent.HandedOver(cut));
  EXPECT_TRUE(peer.sent.HandedOver(cut + 1));
}

/// Numbers of frames that are blocks, and that are not, among what went on the line. Pieces of blocks that
/// were cut off are neither.
std::pair<int, int> BlocksAndOthers(const std::vector<std::byte>& wire) {
  std::pair<int, int> count;
  for (auto begin = wire.begin(); begin != wire.end();) {
    const auto end = std::find(begin, wire.end(), kDelimiter);
    if (end == wire.end()) break;
    if (DecodeBlock({begin, end})) ++count.first;
    if (end != begin && CobsDecode({begin, end})) ++count.second;
    begin = end + 1;
  }
  return count;
}

TEST_F(FrameSchedulerTest, AnUrgentEventGoesAsAShortFrameAndIsRepeatedInBlocks) {
  Hear(1);
  Run(300);
  Offer(kStopDown, "!");
  const auto [blocks, others] = BlocksAndOthers(Run(120));
  EXPECT_GE(blocks, 2);
  EXPECT_EQ(others, 1);
}

TEST_F(FrameSchedulerTest, ANewUrgentEventIsAShortFrameWhenTheLineMayStillAnswer) {
  Hear(1);
  Run(300);
  Offer(kStopDown, "!");
  auto wire = Run(17);
  Offer(kStopDown, "?");
  for (const std::byte b : Run(30)) wire.push_back(b);
  EXPECT_EQ(BlocksAndOthers(wire), std::pair(0, 2));
}

TEST_F(FrameSchedulerTest, ANewUrgentEventIsABlockWhenTheLineDoesNotAnswer) {
  Hear(1);
  Run(300);
  Offer(kStopDown, "!");
  auto wire = Run(170);
  Offer(kStopDown, "?");
  for (const std::byte b : Run(60)) wire.push_back(b);
  EXPECT_EQ(BlocksAndOthers(wire).second, 1);
}

TEST_F(FrameSchedulerTest, DatagramsAreNoBlocks) {
  options.datagrams = true;
  dut = FrameScheduler(table, FrameSealer(FrameKeys(kKey), Direction::kDown, scope), options, false, now);
  Hear(1);
  Offer(kStopDown, "!");
  const auto [blocks, others] = BlocksAndOthers(Run(100));
  EXPECT_EQ(blocks, 0);
  EXPECT_GE(others, 2);
}

struct HalfDuplexSchedulerTest : FrameSchedulerTest {
  HalfDuplexSchedulerTest()
      : FrameSchedulerTest({.half_duplex = {.turn = Duration(400'000), .turnaround = Duration(20'000)}}) {}
};

TEST_F(HalfDuplexSchedulerTest, TalksOnlyInItsTurnAndEndsIt) {
  Hear(1);
  Offer(kEventDown, std::string(100, 'x'));
  EXPECT_TRUE(Run(70).empty());  // the onboard end begins
  dut.OnOver(now);
  EXPECT_TRUE(Run(19).empty());  // the modem over there turns around
  EXPECT_FALSE(Run(200).empty());
  dut.OnBytes(now);
  EXPECT_TRUE(Run(70).empty());
}

TEST_F(HalfDuplexSchedulerTest, ATurnHasAnEndHoweverMuchWaits) {
  Hear(1);
  for (int i = 0; i < 40; ++i) Offer(kEventDown, std::string(200, 'x'));
  dut.OnOver(now);
  Run(20);
  std::size_t bytes = 0;
  for (int i = 0; i < 600; ++i) {
    dut.OnBytes(now);
    bytes += Run(1).size();
  }
  EXPECT_LE(bytes, 384U);  // 0.4 s of the line
  EXPECT_GE(bytes, 200U);
}

}  // namespace
}  // namespace priamos::bus::radio
