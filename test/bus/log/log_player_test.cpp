#include "bus/log/log_player.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A log of 100 events at 10 Hz: 9.9 s.
class PlayerTest : public testing::Test {
 protected:
  PlayerTest() {
    for (int i = 0; i < 100; ++i) AddEvent(kStart_us + i * 100'000, i % 2 ? "ODD" : "EVEN");
  }
  void AddEvent(std::int64_t utime, const std::string& channel) {
    AppendEvent(text_, number_++, utime, channel, std::vector<std::byte>(5));
  }
  LogPlayer Dut(LogSelection selection = {}) const {
    return LogPlayer(LogReader(std::as_bytes(std::span(text_))), std::move(selection));
  }
  /// Plays from now_ to now_ + time in steps of 1 ms; returns the number of events.
  int PlayFor(LogPlayer& dut, Duration time) {
    int sent = 0;
    for (const Time end = now_ + time; now_ < end; now_ += milliseconds(1))
      sent += dut.Play(now_, [&](const std::string& channel, const LogEvent& event) {
        channels_.push_back(channel);
        last_ = event.number;
      });
    return sent;
  }
  static constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
  std::string text_;
  std::int64_t number_ = 0;
  Time now_ = FromUtime(5'000'000);
  std::vector<std::string> channels_;
  std::int64_t last_ = -1;
};

TEST_F(PlayerTest, KeepsTheTimeOfTheLog) {
  auto dut = Dut();
  EXPECT_EQ(PlayFor(dut, milliseconds(951)), 10);
  EXPECT_EQ(dut.NextDue() - now_, milliseconds(49));
  EXPECT_EQ(PlayFor(dut, seconds(20)), 90);
  EXPECT_TRUE(dut.done());
  EXPECT_EQ(dut.NextDue(), Time::max());
}

TEST_F(PlayerTest, SpeedScalesTime) {
  auto dut = Dut();
  dut.SetSpeed(1.0 / 64, now_);
  EXPECT_EQ(PlayFor(dut, milliseconds(6401)), 2);
  dut.SetSpeed(8, now_);
  EXPECT_EQ(PlayFor(dut, seconds(1)), 80);
}

TEST_F(PlayerTest, FlatOutSendsAtOnceInBoundedPortions) {
  auto dut = Dut();
  dut.SetSpeed(LogPlayer::kFlatOut, now_);
  int sent = 0;
  const auto count = [&](const std::string&, const LogEvent&) { ++sent; };
  EXPECT_EQ(dut.Play(now_, count, 60), 60);
  EXPECT_EQ(dut.Play(now_, count, 60), 40);
  EXPECT_EQ(sent, 100);
}

TEST_F(PlayerTest, PauseHoldsAndGoesOnWhereItWas) {
  auto dut = Dut();
  PlayFor(dut, milliseconds(951));
  dut.Pause(true, now_);
  EXPECT_EQ(PlayFor(dut, seconds(5)), 0);
  dut.Pause(false, now_);
  EXPECT_EQ(PlayFor(dut, milliseconds(301)), 4);
  EXPECT_EQ(last_, 13);
}

TEST_F(PlayerTest, StepSendsOneEventAndPauses) {
  auto dut = Dut();
  dut.Step(now_);
  EXPECT_EQ(PlayFor(dut, seconds(1)), 1);
  EXPECT_EQ(last_, 0);
  dut.Step(now_);
  dut.Step(now_);
  EXPECT_EQ(PlayFor(dut, seconds(1)), 2);
  EXPECT_TRUE(dut.paused());
}

TEST_F(PlayerTest, SeekGoesForwardAndBackAndIsCut) {
  auto dut = Dut();
  dut.Seek(seconds(5), now_);
  PlayFor(dut, milliseconds(1));
  EXPECT_EQ(last_, 50);
  dut.Seek(seconds(-5), now_);
  PlayFor(dut, milliseconds(1));
  EXPECT_EQ(last_, 0);
  dut.Seek(seconds(500), now_);
  PlayFor(dut, milliseconds(1));
  EXPECT_EQ(last_, 99);
}

TEST_F(PlayerTest, LoopBeginsAgain) {
  auto dut = Dut();
  dut.SetLoop(true);
  EXPECT_NEAR(PlayFor(dut, seconds(30)), 303, 3);
  EXPECT_EQ(dut.rounds(), 3u);
}

TEST_F(PlayerTest, SelectionFiltersAndRenames) {
  LogSelection selection;
  selection.only = {"ODD"};
  selection.rename = {{"ODD", "NEW"}};
  auto dut = Dut(selection);
  EXPECT_EQ(PlayFor(dut, seconds(20)), 50);
  EXPECT_EQ(channels_, std::vector<std::string>(50, "NEW"));
}

TEST_F(PlayerTest, OneDamagedTimeDoesNotStopIt) {
  AddEvent(std::int64_t{1} << 52, "FUTURE");
  AddEvent(kStart_us + 10'000'000, "NEXT");
  AddEvent(7, "PAST");
  AddEvent(kStart_us + 10'100'000, "LAST");
  auto dut = Dut();
  EXPECT_EQ(PlayFor(dut, seconds(11)), 104);
  EXPECT_EQ(channels_.back(), "LAST");
}

TEST_F(PlayerTest, EmptyLogIsDoneAtOnce) {
  text_.clear();
  auto dut = Dut();
  EXPECT_TRUE(dut.done());
  EXPECT_EQ(dut.length(), Duration());
  dut.Seek(seconds(1), now_);
  EXPECT_EQ(PlayFor(dut, seconds(1)), 0);
}

}  // namespace
}  // namespace priamos::bus
