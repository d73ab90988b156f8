#include "bus/clocks/repeated_messages.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "bus/clocks/log_time.hpp"

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;

constexpr Time kBegin{std::chrono::hours(480'000)};
constexpr int kStamps = RepeatedMessages::kStamps;

class RepeatedMessagesTest : public testing::Test {
 protected:
  void Hear(std::uint64_t message, Time stamp) {
    dut_.Hear(message, stamp, newest_);
    newest_ = std::max(newest_, stamp);
  }
  /// Messages number `begin` to `end`, 10 ms apart.
  void Play(int begin, int end) {
    for (int i = begin; i < end; ++i) Hear(static_cast<std::uint64_t>(i), kBegin + milliseconds(10 * i));
  }
  Time newest_ = Time::min();
  RepeatedMessages dut_;
};

TEST_F(RepeatedMessagesTest, ALogThatGoesOnDoesNotRepeat) {
  Play(0, 5000);
  EXPECT_FALSE(dut_.is_repeating());
}

TEST_F(RepeatedMessagesTest, TenStampsThatComeAgainTellIt) {
  Play(0, 100);
  Play(0, kStamps - 1);
  EXPECT_TRUE(dut_.is_repeating());
  EXPECT_FALSE(dut_.began_again());
  Play(kStamps - 1, kStamps);
  EXPECT_TRUE(dut_.began_again());
}

TEST_F(RepeatedMessagesTest, OfAShorterLogAllOfThem) {
  Play(0, 3);
  Play(0, 2);
  EXPECT_FALSE(dut_.began_again());
  Play(2, 3);
  EXPECT_TRUE(dut_.began_again());
}

TEST_F(RepeatedMessagesTest, ASeekBackTellsItAsWell) {
  Play(0, 100);
  Play(60, 60 + kStamps);
  EXPECT_TRUE(dut_.began_again());
}

TEST_F(RepeatedMessagesTest, AnOrderThatIsSaidAgainDoesNot) {
  Play(0, 20);
  for (int i = 0; i < 100; ++i) Hear(19, newest_);
  EXPECT_FALSE(dut_.began_again());
}

TEST_F(RepeatedMessagesTest, NorDoesABlockThatIsSentAgainAtOnce) {
  Play(0, 20);
  const Time sent = newest_;
  for (int time = 0; time < 3; ++time)
    for (std::uint64_t i = 1000; i < 1040; ++i) Hear(i, sent);
  EXPECT_FALSE(dut_.began_again());
}

TEST_F(RepeatedMessagesTest, WhatGoesOnEndsTheRun) {
  Play(0, 100);
  for (int i = 0; i < kStamps; ++i) {
    Play(i, i + 1);
    Hear(static_cast<std::uint64_t>(1000 + i), newest_ + milliseconds(10));
  }
  EXPECT_FALSE(dut_.is_repeating());
}

TEST_F(RepeatedMessagesTest, AMessageThatWasLostTheFirstTimeDoesNotHideIt) {
  Play(0, 5);
  Play(6, 100);
  Play(0, kStamps + 1);
  EXPECT_TRUE(dut_.began_again());
}

/// A run is ended by so many of them, or it would be kept for ever.
TEST_F(RepeatedMessagesTest, ManyNewOnesWithOldStampsEndTheRun) {
  Play(0, 100);
  Play(0, 1);
  for (int i = 0; i <= RepeatedMessages::kMostNew; ++i) Hear(static_cast<std::uint64_t>(500 + i), kBegin);
  EXPECT_FALSE(dut_.is_repeating());
}

TEST_F(RepeatedMessagesTest, OldMessagesAreForgotten) {
  Play(0, 2 * RepeatedMessages::kKept);
  Play(0, 100);
  EXPECT_FALSE(dut_.is_repeating()) << "their stamps, which are far behind, tell it: LogTime";
}

/// Whatever the log, played a second time it is noticed before its end, when its stamps are not all the same.
RC_GTEST_PROP(RepeatedMessagesProperty, EveryLogPlayedAgainIsNoticed, ()) {
  const auto stamps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 3000));
  RC_PRE(std::set<int>(stamps.begin(), stamps.end()).size() >= RepeatedMessages::kFewest);
  LogTime dut;
  const auto play = [&] {
    for (std::size_t i = 0; i < stamps.size(); ++i) dut.Hear(kBegin + milliseconds(stamps[i] % 2000), i);
  };
  play();
  if (!dut.went_back()) play();
  RC_ASSERT(dut.went_back());
}

TEST(IdentityOf, TellsChannelsAndBytesApart) {
  const std::vector<std::byte> a{std::byte{1}}, b{std::byte{2}};
  EXPECT_EQ(IdentityOf("POSE", a), IdentityOf("POSE", a));
  EXPECT_NE(IdentityOf("POSE", a), IdentityOf("POSE", b));
  EXPECT_NE(IdentityOf("POSE", a), IdentityOf("PATH", a));
}

}  // namespace
}  // namespace priamos::bus
