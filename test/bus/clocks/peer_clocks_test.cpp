#include "bus/clocks/peer_clocks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Kind = SenderClock::Kind;

constexpr Time kBegin{std::chrono::hours(480'000)};
constexpr std::uint32_t kBaseAddress = 0x01004d0a, kVisionAddress = 0x02004d0a;  // 10.77.0.1 and .2

constexpr std::uint64_t Socket(std::uint32_t address, std::uint16_t port) {
  return std::uint64_t{address} << 16 | port;
}

/// One process on each of two hosts; the clock of vision is a second ahead.
class TwoHosts : public testing::Test {
 protected:
  static constexpr std::int32_t kBase = 11, kVision = 22;
  static constexpr Duration kAhead = seconds(1), kOnTheWay = milliseconds(2);
  static constexpr std::uint64_t kBaseSocket = Socket(kBaseAddress, 1),
                                 kVisionSocket = Socket(kVisionAddress, 1);

  bool BaseSpeaks() {
    clock_report_t message = base_.Report(now_);
    message.host = "base";
    now_ += kOnTheWay;
    return vision_.Hear(kBaseSocket, message, now_ + kAhead);
  }
  bool VisionSpeaks() {
    clock_report_t message = vision_.Report(now_ + kAhead);
    message.host = "vision";
    now_ += kOnTheWay;
    return base_.Hear(kVisionSocket, message, now_);
  }

  Time now_ = kBegin;
  PeerClocks base_{kBase, {kBaseAddress}}, vision_{kVision, {kVisionAddress}};
};

TEST_F(TwoHosts, KnowEachOthersClockAfterThreeMessages) {
  EXPECT_TRUE(BaseSpeaks()) << "waits for an answer";
  EXPECT_TRUE(VisionSpeaks()) << "has heard base, but knows nothing yet";
  EXPECT_EQ(base_.ClockOf(kVisionSocket, now_).kind, Kind::kKnown);
  EXPECT_EQ(vision_.ClockOf(kBaseSocket, now_).kind, Kind::kUnknown);
  EXPECT_TRUE(BaseSpeaks()) << "2.1 ms is not well";
  now_ += PeerClocks::kAcquaintance;
  EXPECT_FALSE(VisionSpeaks()) << "but enough for the rest of the time";
  const auto clock = base_.ClockOf(kVisionSocket, now_);
  EXPECT_EQ(clock.difference.ahead, kAhead);
  EXPECT_LE(clock.difference.uncertainty, milliseconds(3));
  EXPECT_EQ(clock.host, "vision");
  EXPECT_EQ(vision_.ClockOf(kBaseSocket, now_ + kAhead).difference.ahead, -kAhead);
}

TEST_F(TwoHosts, ReportWhatTheyKnow) {
  for (int i = 0; i < 2; ++i) {
    BaseSpeaks();
    VisionSpeaks();
  }
  const auto report = base_.Report(now_);
  ASSERT_EQ(report.count, 1);
  EXPECT_EQ(report.heard_id.front(), kVision);
  EXPECT_NEAR(report.ahead_s.front(), 1, 0.001);
  EXPECT_NEAR(report.uncertainty_s.front(), 0.002, 0.001);
}

TEST_F(TwoHosts, TheClockOfTheLowestNumberIsTheReference) {
  EXPECT_EQ(vision_.AheadOfReference(now_ + kAhead)->uncertainty, Duration{}) << "alone";
  BaseSpeaks();
  EXPECT_EQ(vision_.AheadOfReference(now_ + kAhead), std::nullopt) << "has heard base, but knows nothing yet";
  VisionSpeaks();
  BaseSpeaks();
  const auto ours = base_.AheadOfReference(now_), theirs = vision_.AheadOfReference(now_ + kAhead);
  ASSERT_TRUE(ours && theirs);
  EXPECT_EQ(ours->ahead, Duration{});
  EXPECT_EQ(ours->uncertainty, Duration{});
  EXPECT_EQ(theirs->ahead, kAhead);
  EXPECT_GT(theirs->uncertainty, Duration{});
  EXPECT_LE(theirs->uncertainty, milliseconds(3));
}

TEST_F(TwoHosts, AReferenceThatIsSilentIsNone) {
  BaseSpeaks();
  now_ += PeerClocks::kForgotten;
  EXPECT_EQ(vision_.AheadOfReference(now_ + kAhead), std::nullopt);
  now_ += seconds(1);
  ASSERT_TRUE(vision_.AheadOfReference(now_ + kAhead));
  EXPECT_EQ(vision_.AheadOfReference(now_ + kAhead)->ahead, Duration{});
}

TEST_F(TwoHosts, ASecondProcessOfAHostNeedsNoExchangeOfItsOwn) {
  for (int i = 0; i < 2; ++i) {
    BaseSpeaks();
    VisionSpeaks();
  }
  PeerClocks late(kBase, {kBaseAddress});
  clock_report_t message = vision_.Report(now_ + kAhead);
  late.Hear(kVisionSocket, message, now_ + kOnTheWay);
  EXPECT_EQ(late.ClockOf(kVisionSocket, now_ + kOnTheWay).kind, Kind::kKnown);
}

TEST_F(TwoHosts, WhoSaysNothingOfItsClockHasThatOfItsComputer) {
  BaseSpeaks();
  VisionSpeaks();
  EXPECT_EQ(base_.ClockOf(Socket(kVisionAddress, 99), now_).kind, Kind::kKnown);
  EXPECT_EQ(base_.ClockOf(Socket(kBaseAddress, 99), now_).kind, Kind::kOurs);
  EXPECT_EQ(base_.ClockOf(Socket(0x0300a8c0, 99), now_).kind, Kind::kUnknown);
}

TEST_F(TwoHosts, TwoClocksAtOneAddressAreToldApartByTheirSockets) {
  BaseSpeaks();
  VisionSpeaks();
  PeerClocks container(33, {});
  clock_report_t message = container.Report(now_);
  message.host = "container";
  base_.Hear(Socket(kVisionAddress, 2), message, now_);
  EXPECT_EQ(base_.ClockOf(Socket(kVisionAddress, 2), now_).kind, Kind::kUnknown);
  EXPECT_EQ(base_.ClockOf(kVisionSocket, now_).kind, Kind::kKnown);
}

/// A machine that was copied while it ran goes on with the number of the other one.
TEST_F(TwoHosts, OurNumberAtAnotherHostIsNoClockOfOurs) {
  PeerClocks copy(kBase, {kVisionAddress});
  clock_report_t message = copy.Report(now_ + kAhead);
  message.host = "base";
  ASSERT_TRUE(base_.IsCopy(kVisionSocket, message));
  EXPECT_FALSE(base_.Hear(kVisionSocket, message, now_));
  EXPECT_EQ(base_.ClockOf(kVisionSocket, now_).kind, Kind::kCopied);
  EXPECT_EQ(base_.ClockOf(kVisionSocket, now_).host, "base");
  EXPECT_EQ(base_.AheadOfReference(now_), std::nullopt) << "which of the two is meant, nobody can tell";

  base_.SetOwnAddresses({kBaseAddress, kVisionAddress});
  EXPECT_FALSE(base_.Hear(kVisionSocket, message, now_)) << "it was an address of this host that is new";
  EXPECT_EQ(base_.ClockOf(kVisionSocket, now_).kind, Kind::kOurs);
  EXPECT_NE(base_.AheadOfReference(now_), std::nullopt);
}

/// The clock of vision goes back by a second: older messages of it raise the doubt.
TEST_F(TwoHosts, AClockInDoubtIsAskedForUntilAnExchangeSettlesIt) {
  for (int i = 0; i < 2; ++i) {
    BaseSpeaks();
    VisionSpeaks();
  }
  now_ += PeerClocks::kAcquaintance;
  EXPECT_FALSE(base_.Doubt(Socket(0x0300a8c0, 1), now_)) << "a sender of whom nothing is known";
  EXPECT_TRUE(base_.Doubt(kVisionSocket, now_));
  EXPECT_GT(base_.Report(now_).uncertainty_s.front(), 50) << "so that vision answers at once";
  EXPECT_TRUE(VisionSpeaks()) << "answers something from before the doubt";
  EXPECT_TRUE(base_.Doubt(kVisionSocket, now_));
  EXPECT_TRUE(BaseSpeaks());
  EXPECT_FALSE(VisionSpeaks());
  EXPECT_FALSE(base_.Doubt(kVisionSocket, now_)) << "settled, and not raised again at once";
  now_ += PeerClocks::kDoubt + milliseconds(1);
  EXPECT_TRUE(base_.Doubt(kVisionSocket, now_));
}

TEST_F(TwoHosts, ADoubtThatNobodyAnswersEnds) {
  BaseSpeaks();
  VisionSpeaks();
  EXPECT_TRUE(base_.Doubt(kVisionSocket, now_));
  now_ += PeerClocks::kDoubt + milliseconds(1);
  EXPECT_FALSE(base_.Doubt(kVisionSocket, now_));
}

TEST_F(TwoHosts, OfManyClocksTheFirstAreUsedAndTheSilentOnesMakeRoom) {
  clock_report_t message{};
  message.utime = ToUtime(now_);
  for (int i = 0; i < 100; ++i) {
    message.clock_id = 1000 + i;
    base_.Hear(Socket(0x0300a8c0, static_cast<std::uint16_t>(i)), message, now_);
  }
  EXPECT_EQ(base_.Report(now_).count, static_cast<int>(PeerClocks::kMostClocks));
  now_ += PeerClocks::kForgotten + seconds(1);
  BaseSpeaks();
  VisionSpeaks();
  EXPECT_EQ(base_.ClockOf(kVisionSocket, now_).kind, Kind::kKnown);
}

/// Anybody may send CLOCK: no message makes a known clock worse than its uncertainty says, unless it comes
/// from the same clock, nor is anything computed with a time that is none.
RC_GTEST_PROP(PeerClocksProperty, NonsenseFromAnotherChangesNothing, ()) {
  PeerClocks dut(1, {kBaseAddress});
  const auto time =
      rc::gen::oneOf(rc::gen::arbitrary<std::int64_t>(),
                     rc::gen::inRange(ToUtime(kBegin) - 1'000'000, ToUtime(kBegin) + 1'000'000));
  clock_report_t message{};
  message.utime = *time;
  message.clock_id = 2;
  message.count = static_cast<std::int8_t>(*rc::gen::inRange(0, 17));
  for (int i = 0; i < message.count; ++i) {
    message.heard_id.push_back(*rc::gen::inRange(0, 3));
    message.utime_heard.push_back(*time);
    message.utime_arrived.push_back(*time);
    message.ahead_s.push_back(0);
    message.uncertainty_s.push_back(*rc::gen::arbitrary<float>());
  }
  dut.Hear(Socket(kVisionAddress, 1), message, kBegin);
  const auto clock = dut.ClockOf(Socket(kVisionAddress, 1), kBegin);
  if (clock.kind == Kind::kKnown) {
    RC_ASSERT(clock.difference.uncertainty >= Duration::zero());
    RC_ASSERT(clock.difference.uncertainty <= ClockOffset::kLongest);
  }
}

}  // namespace
}  // namespace priamos::bus
