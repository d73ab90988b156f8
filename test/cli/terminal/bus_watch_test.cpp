#include "cli/terminal/bus_watch.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "bus/own_types.hpp"

namespace priamos::cli {
namespace {

using testing::ElementsAre;

class LinkListenerTest : public testing::Test {
 protected:
  /// What was asked for since the last call, as "CHANNEL for so long".
  std::vector<std::string> Asked() {
    bus_.Drain();
    std::vector<std::string> asked;
    for (const link_request_t& request : requests_.Drain())
      asked.push_back(fmt::format("{} {}", request.channel, request.hold_s));
    return asked;
  }
  const bus::Schema schema_ = bus::OwnTypes();
  const bus::SimulatedClock clock_{FromUtime(1'000'000'000)};
  bus::LcmBus bus_{"memq://"};
  bus::Node node_{bus_, schema_, clock_}, other_{bus_, schema_, clock_};
  bus::Inbox<link_request_t> requests_ = other_.SubscribeAll(channels::kLinkRequest);
  const Time start_ = clock_.Now();
};

TEST_F(LinkListenerTest, AsksForEveryChannelAtOnceAndAgainEverySecond) {
  LinkListener dut(node_, {"POSE", "SONAR_RANGES"});
  EXPECT_THAT(Asked(), testing::IsEmpty()) << "not before the first step";
  dut.Step(start_);
  EXPECT_THAT(Asked(), ElementsAre("POSE 3", "SONAR_RANGES 3"));
  dut.Step(start_ + std::chrono::milliseconds(999));
  EXPECT_THAT(Asked(), testing::IsEmpty());
  dut.Step(start_ + std::chrono::milliseconds(1000));
  EXPECT_EQ(Asked().size(), 2u);
}

TEST_F(LinkListenerTest, ARequestHoldsUntilThreeOfItsRepetitionsAreLost) {
  LinkListener dut(node_, {"POSE"});
  dut.Step(start_);
  bus_.Drain();
  EXPECT_GE(requests_.Drain().at(0).hold_s, 3) << "the radio may lose what is asked once a second";
}

TEST_F(LinkListenerTest, ThankYouNoMoreIsItsLastWord) {
  {
    LinkListener dut(node_, {"POSE"});
    dut.Step(start_);
    Asked();
  }
  EXPECT_THAT(Asked(), ElementsAre("POSE 0"));
}

class WatchTest : public testing::Test {
 protected:
  bus::LcmBus bus_{"memq://"};
  bus::SimulatedClock clock_{FromUtime(1'000'000'000)};
};

TEST_F(WatchTest, EndsAtItsTime) {
  int steps = 0;
  bus_.SubscribeEverything([](std::string_view, std::span<const std::byte>) {});
  bus_.Publish("A", {});
  Watch(
      bus_, clock_, clock_.Now() + std::chrono::seconds(1), [] { return false; },
      [&] {
        ++steps;
        clock_.Set(clock_.Now() + std::chrono::milliseconds(500));
        bus_.Publish("A", {});  // so that nobody waits
      });
  EXPECT_EQ(steps, 2);
}

TEST_F(WatchTest, WhatIsDoneIsNotWaitedFor) {
  Watch(
      bus_, clock_, Time::max(), [] { return true; }, [] { FAIL() << "a step too much"; });
}

TEST_F(WatchTest, MessagesAreHandledBeforeEachStep) {
  int heard = 0, steps = 0;
  bus_.SubscribeEverything([&](std::string_view, std::span<const std::byte>) { ++heard; });
  for (int i = 0; i < 5; ++i) bus_.Publish("A", {});
  Watch(
      bus_, clock_, Time::max(), [&] { return steps > 0; },
      [&] {
        ++steps;
        EXPECT_EQ(heard, 5);
      });
}

}  // namespace
}  // namespace priamos::cli
