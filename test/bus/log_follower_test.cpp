#include "bus/log_follower.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>

#include "bus/own_types.hpp"

// With a bus, a player and the planner: test/system/log/followed_log_test.cpp.

namespace priamos::bus {
namespace {

using std::chrono::hours;
using std::chrono::seconds;

TEST(LogFollower, WhatItSendsIsOnChannelsOfItsOwn) {
  const Schema schema{std::vector<Schema::Source>{}};
  LcmBus bus("memq://");
  std::string heard;
  LogFollower follower(bus, schema, "planner", {});
  bus.SubscribeEverything([&](std::string_view channel, std::span<const std::byte>) { heard = channel; });
  bus.Publish("PATH", {});
  bus.Drain();
  EXPECT_EQ(heard, "REPLAYED_PATH");
}

/// Notes when it ticks, once a second.
class TickNoter : public AnyApp {
 public:
  using OnTick = std::function<void(Time now, Context& context)>;
  TickNoter(Context& context, OnTick on_tick) : context_(context), on_tick_(std::move(on_tick)) {}
  Duration TickPeriod() const override { return seconds(1); }
  void Tick(Time now) override { on_tick_(now, context_); }
  void Yield(Time) override {}

 private:
  Context& context_;
  OnTick on_tick_;
};

/// The signals that are blocked, as they were before a SignalWatch.
class KeptSignalMask {
 public:
  KeptSignalMask() { pthread_sigmask(SIG_SETMASK, nullptr, &mask_); }
  ~KeptSignalMask() { pthread_sigmask(SIG_SETMASK, &mask_, nullptr); }
  KeptSignalMask(const KeptSignalMask&) = delete;
  KeptSignalMask& operator=(const KeptSignalMask&) = delete;

 private:
  sigset_t mask_{};
};

/// A log that begins at kBegin and goes on `gap` later.
class LogWithAGap : public testing::Test {
 protected:
  static constexpr Time kBegin{hours(480'000)};
  static constexpr int kTooManyTicks = 3;  ///< exit code
  static constexpr std::size_t kMostTicks = 1000;

  void Play(Time stamp) {
    pose_t pose{};
    pose.utime = ToUtime(stamp);
    bus_.PublishUnder("");
    bus_.Publish("POSE", Encode(pose));
    bus_.PublishUnder(LogFollower::kPrefix);
  }

  /// Runs an App on that log; returns its exit code.
  std::optional<int> Follow(Duration gap, const TickNoter::OnTick& on_tick) {
    AppFactory factory;
    factory.name = "noter";
    factory.start = [&](const ConfigSource&, Context& context) {
      return std::make_unique<TickNoter>(context, [&](Time now, Context& around) {
        ticks_.push_back(now);
        if (ticks_.size() > kMostTicks) around.RequestStop(kTooManyTicks);
        on_tick(now, around);
      });
    };
    LogFollower dut(bus_, schema_, factory.name, [&](const Clock& clock) {
      auto host = std::make_unique<AppHost>(factory, ConfigSource{}, bus_, schema_, clock, Surroundings{});
      for (int i = 0; i < LogTime::kWitnesses; ++i) Play(kBegin + gap);
      return host;
    });
    Play(kBegin);
    return dut.Run(signals_);
  }

  const Schema schema_ = OwnTypes();
  const KeptSignalMask mask_;
  const SignalWatch signals_;
  LcmBus bus_{"memq://"};
  std::vector<Time> ticks_;
};

TEST_F(LogWithAGap, OfAGapItLivesThroughTheLastMinute) {
  const auto code = Follow(hours(1), [](Time now, Context& context) {
    if (now >= kBegin + hours(1) - seconds(1)) context.RequestStop(0);
  });
  EXPECT_EQ(code, 0);
  ASSERT_EQ(ticks_.size(), 60U);
  EXPECT_EQ(ticks_.front(), kBegin + hours(1) - seconds(60));
}

TEST_F(LogWithAGap, AMinuteIsNoGap) {
  const auto code = Follow(seconds(60), [](Time now, Context& context) {
    if (now >= kBegin + seconds(59)) context.RequestStop(0);
  });
  EXPECT_EQ(code, 0);
  ASSERT_EQ(ticks_.size(), 60U);
  EXPECT_EQ(ticks_.front(), kBegin);
}

/// As after a stamp that is wrong by a century.
TEST_F(LogWithAGap, ASignalIsHeardBehindAnyGap) {
  const auto code = Follow(hours(24 * 365 * 100), [](Time, Context&) { std::raise(SIGINT); });
  EXPECT_EQ(code, 0);
  EXPECT_LE(ticks_.size(), 60U);
  char taken[1024];
  EXPECT_GT(read(signals_.fd(), taken, sizeof taken), 0) << "else it would end the test itself";
}

/// What an App heard at its ticks.
struct Heard {
  int commands = 0, poses = 0;
  friend bool operator==(const Heard&, const Heard&) = default;
};

/// Counts what it hears, and stops at a time of the log.
class Counter : public AnyApp {
 public:
  Counter(Context& context, Heard& heard, Time end)
      : context_(context),
        heard_(heard),
        end_(end),
        commands_(context.node().SubscribeAll(channels::kMissionCommand)),
        poses_(context.node().SubscribeAll(channels::kPose)) {}
  Duration TickPeriod() const override { return std::chrono::milliseconds(100); }
  void Tick(Time now) override {
    heard_.commands += static_cast<int>(commands_.Drain().size());
    heard_.poses += static_cast<int>(poses_.Drain().size());
    if (now >= end_) context_.RequestStop(0);
  }
  void Yield(Time) override {}

 private:
  Context& context_;
  Heard& heard_;
  Time end_;
  Inbox<mission_command_t> commands_;
  Inbox<pose_t> poses_;
};

/// A log of which the first message is an order, played several times onto a bus that is followed.
class LogPlayedAgain : public LogWithAGap {
 protected:
  /// A log of `length`, with 10 poses a second.
  void PlayLog(Duration length) {
    bus_.PublishUnder("");
    mission_command_t command{};
    command.utime = ToUtime(kBegin);
    bus_.Publish("MISSION_COMMAND", Encode(command));
    bus_.PublishUnder(LogFollower::kPrefix);
    for (Time now = kBegin; now <= kBegin + length; now += std::chrono::milliseconds(100)) Play(now);
  }

  /// What each App heard until the last one stops, a second before the end.
  std::vector<Heard> Follow(Duration length, std::size_t plays) {
    std::vector<Heard> heard;
    AppFactory factory;
    factory.name = "counter";
    factory.start = [&](const ConfigSource&, Context& context) {
      const bool last = heard.size() == plays;
      return std::make_unique<Counter>(context, heard.back(),
                                       last ? kBegin + length - seconds(1) : Time::max());
    };
    for (std::vector<HeardMessage> first;;) {
      heard.emplace_back();
      LogFollower dut(
          bus_, schema_, factory.name,
          [&](const Clock& clock) {
            return std::make_unique<AppHost>(factory, ConfigSource{}, bus_, schema_, clock, Surroundings{});
          },
          std::move(first));
      for (; played_ < plays; ++played_) PlayLog(length);
      if (dut.Run(signals_)) return heard;
      first = dut.TakeBeginning();
    }
  }
  std::size_t played_ = 0;
};

TEST_F(LogPlayedAgain, EachTimeAllOfItIsHeard) {
  const auto heard = Follow(seconds(9), 3);
  ASSERT_EQ(heard.size(), 3U);
  for (const Heard& play : heard) {
    EXPECT_EQ(play.commands, 1);
    EXPECT_GE(play.poses, 79);
  }
  EXPECT_EQ(heard[1], heard[0]);
}

/// As of a log of which only the beginning is played.
TEST_F(LogPlayedAgain, ALogOfTwoSecondsIsEnough) {
  const auto heard = Follow(seconds(2), 3);
  ASSERT_EQ(heard.size(), 3U);
  for (const Heard& play : heard) EXPECT_EQ(play.commands, 1);
  EXPECT_EQ(heard[1].poses, heard[0].poses);
}

/// What it heard last, by which it would notice, is too little: that is said.
TEST_F(LogPlayedAgain, WhatIsTooShortToFollowIsSaid) {
  AppFactory factory;
  factory.name = "noter";
  factory.start = [&](const ConfigSource&, Context& context) {
    return std::make_unique<TickNoter>(context, [&](Time now, Context& around) {
      if (now < kBegin + seconds(8)) return;
      for (int i = 0; i < 3; ++i) Play(kBegin + seconds(i));
      around.RequestStop(0);
    });
  };
  LogFollower dut(bus_, schema_, factory.name, [&](const Clock& clock) {
    return std::make_unique<AppHost>(factory, ConfigSource{}, bus_, schema_, clock, Surroundings{});
  });
  PlayLog(seconds(9));
  EXPECT_EQ(dut.NotFollowed(), "") << "nothing was heard";
  ASSERT_EQ(dut.Run(signals_), 0);
  EXPECT_EQ(dut.NotFollowed(), "");
  bus_.Drain();
  EXPECT_THAT(dut.NotFollowed(), testing::StartsWith("3 messages are from earlier in the log"));
}

TEST_F(LogPlayedAgain, ABusWithoutStampsIsSaid) {
  LogFollower dut(bus_, schema_, "noter", {});
  bus_.PublishUnder("");
  for (int i = 0; i < 4; ++i) bus_.Publish("FOREIGN", std::vector<std::byte>(12, std::byte{7}));
  bus_.Drain();
  EXPECT_THAT(dut.NotFollowed(), testing::StartsWith("4 messages heard, none with a time stamp"));
}

}  // namespace
}  // namespace priamos::bus
