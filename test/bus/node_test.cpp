#include "bus/node.hpp"

#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {
namespace {

class NodeTest : public testing::Test {
 protected:
  Schema schema_ = OwnTypes();
  SimulatedClock clock_{FromUtime(1'000'000)};
  LcmBus bus_{"memq://"};
  Node dut_{bus_, schema_, clock_};

  static pose_t Pose(double x) {
    pose_t pose{};
    pose.x_m = x;
    return pose;
  }
};

TEST_F(NodeTest, BeforeTheFirstMessageThereIsNothingAndItIsInfinitelyOld) {
  const auto latest = dut_.Subscribe(channels::kPose);
  EXPECT_EQ(latest.get(), nullptr);
  EXPECT_EQ(latest.Age(clock_.Now()), Duration::max());
}

TEST_F(NodeTest, NewestMessageWins) {
  auto latest = dut_.Subscribe(channels::kPose);
  auto publisher = dut_.Advertise(channels::kPose);
  publisher.Publish(Pose(1));
  publisher.Publish(Pose(2));
  bus_.Drain();
  EXPECT_EQ(latest.get()->x_m, 2);
  EXPECT_EQ(latest.Take()->x_m, 2);
  EXPECT_FALSE(latest.Take());
  EXPECT_EQ(dut_.counters().at("POSE").overwritten, 1u);
}

TEST_F(NodeTest, AgeIsMeasuredFromArrivalByTheReceiversClock) {
  const auto latest = dut_.Subscribe(channels::kPose);
  dut_.Advertise(channels::kPose).Publish(Pose(1));
  bus_.Drain();
  clock_.Set(clock_.Now() + std::chrono::milliseconds(300));
  EXPECT_EQ(latest.Age(clock_.Now()), std::chrono::milliseconds(300));
}

TEST_F(NodeTest, EventsAreAllKeptInOrder) {
  auto inbox = dut_.SubscribeAll(channels::kPose);
  auto publisher = dut_.Advertise(channels::kPose);
  for (int i = 0; i < 3; ++i) publisher.Publish(Pose(i));
  bus_.Drain();
  const auto messages = inbox.Drain();
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[2].x_m, 2);
  EXPECT_TRUE(inbox.Drain().empty());
}

TEST_F(NodeTest, FullInboxCountsWhatItDrops) {
  auto inbox = dut_.SubscribeAll(channels::kPose);
  auto publisher = dut_.Advertise(channels::kPose);
  for (std::size_t i = 0; i < kInboxCapacity + 5; ++i) {
    publisher.Publish(Pose(0));
    bus_.Drain();
  }
  EXPECT_EQ(inbox.Drain().size(), kInboxCapacity);
  EXPECT_EQ(dut_.counters().at("POSE").dropped, 5u);
}

TEST_F(NodeTest, WrongTypeAndDamagedBytesAreRefusedAndCounted) {
  const auto latest = dut_.Subscribe(channels::kPose);
  bus_.Publish("POSE", Encode(health_t{}));
  auto truncated = Encode(Pose(1));
  truncated.resize(truncated.size() - 3);
  bus_.Publish("POSE", truncated);
  bus_.Publish("POSE", {});
  bus_.Drain();
  EXPECT_EQ(latest.get(), nullptr);
  EXPECT_EQ(dut_.counters().at("POSE").refused, 3u);
}

TEST_F(NodeTest, ProblemsAreNamedPerChannel) {
  dut_.Subscribe(channels::kPose);
  dut_.SubscribeRaw("HEALTH", [](std::span<const std::byte>, Time) { throw std::runtime_error("no pose"); });
  EXPECT_EQ(dut_.Problems(), "");
  bus_.Publish("POSE", Encode(health_t{}));
  auto truncated = Encode(Pose(1));
  truncated.resize(truncated.size() - 3);
  bus_.Publish("POSE", truncated);
  bus_.Publish("HEALTH", Encode(health_t{}));
  bus_.Drain();
  EXPECT_EQ(dut_.Problems(), "POSE: 1 of wrong type, 1 damaged; HEALTH: 1 exceptions (no pose)");
}

TEST_F(NodeTest, WhateverIsThrownIsCaught) {
  dut_.SubscribeRaw("POSE", [](std::span<const std::byte>, Time) { throw 42; });
  bus_.Publish("POSE", Encode(Pose(1)));
  bus_.Drain();
  EXPECT_EQ(dut_.counters().at("POSE").exceptions, 1u);
}

TEST_F(NodeTest, OversizeIsCountedAsSuch) {
  const auto latest = dut_.Subscribe(channels::kPose);
  // Past this side's limit, as another LCM program may send.
  LcmBus foreign("memq://", LcmBus::Messages::kAnySize);
  Node dut(foreign, schema_, clock_);
  dut.Subscribe(channels::kPose);
  EXPECT_TRUE(foreign.Publish("POSE", std::vector<std::byte>(5000)));
  foreign.Drain();
  EXPECT_EQ(dut.counters().at("POSE").oversize, 0u);  // any size may be here; it is only of the wrong type
  EXPECT_EQ(dut.counters().at("POSE").wrong_type, 1u);
}

TEST_F(NodeTest, RawSubscriberSeesOnlyBytesThatPassedTheWalk) {
  int seen = 0;
  dut_.SubscribeRaw("POSE", [&](std::span<const std::byte>, Time) { ++seen; });
  bus_.Publish("POSE", Encode(Pose(1)));
  bus_.Publish("POSE", std::vector<std::byte>(40));
  bus_.Drain();
  EXPECT_EQ(seen, 1);
}

TEST_F(NodeTest, ThrowingHandlerIsCountedAndHarmsNoOther) {
  dut_.SubscribeRaw("POSE", [](std::span<const std::byte>, Time) { throw std::runtime_error("x"); });
  const auto latest = dut_.Subscribe(channels::kPose);
  dut_.Advertise(channels::kPose).Publish(Pose(4));
  bus_.Drain();
  EXPECT_EQ(dut_.counters().at("POSE").exceptions, 1u);
  EXPECT_EQ(latest.get()->x_m, 4);
}

TEST_F(NodeTest, MessageAboveTheLimitIsNotSent) {
  dut_.PublishRaw("POSE", std::vector<std::byte>(LcmBus::kMaxMessageBytes + 1));
  EXPECT_EQ(dut_.counters().at("POSE").publish_failed, 1u);
}

TEST_F(NodeTest, InterfaceNamesInputsAndOutputs) {
  dut_.Subscribe(channels::kPose);
  dut_.Advertise(channels::kHealth);
  EXPECT_EQ(dut_.inputs()[0].channel, "POSE");
  EXPECT_EQ(dut_.inputs()[0].type, "pose_t");
  EXPECT_EQ(dut_.outputs()[0].channel, "HEALTH");
}

}  // namespace
}  // namespace priamos::bus
