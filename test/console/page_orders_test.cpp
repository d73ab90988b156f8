#include "console/page_orders.hpp"

#include <gmock/gmock.h>

#include "bus/own_types.hpp"
#include "console/foxglove_bridge.hpp"

namespace priamos::console {
namespace {

using std::chrono::seconds;

class PageOrdersTest : public testing::Test {
 protected:
  void Tick(Duration later) {
    now_ += later;
    bus_.Drain();
    dut_.Tick(now_);
    bus_.Drain();
  }

  const bus::Schema schema_ = bus::OwnTypes();
  const bus::MonotonicClock clock_;
  bus::LcmBus bus_{"memq://"};
  bus::Node node_{bus_, schema_, clock_};
  bus::Inbox<pose_reset_t> places_ = node_.SubscribeAll(channels::kPoseReset);
  bus::Inbox<head_aim_t> aims_ = node_.SubscribeAll(channels::kHeadAim);
  bus::Inbox<alarm_ack_t> acks_ = node_.SubscribeAll(channels::kAlarmAck);
  bus::Publisher<pose_correction_t> corrections_ = node_.Advertise(channels::kPoseCorrection);
  FoxgloveBridge bridge_{schema_, {0.8, 0.6}, "test", [](ClientId, std::string, bool) { return true; }};
  PageOrders dut_{node_, bridge_, 2, {0.15, 5}};
  Time now_ = clock_.Now();
};

TEST_F(PageOrdersTest, WhereTheRobotStandsIsSaidUntilItAnswers) {
  ASSERT_TRUE(dut_.Take(PlaceOrder{{1, 2, 0}}, now_));
  Tick({});
  Tick(seconds(1));
  const auto said = places_.Drain();
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0].request_id, 513) << "another session has other numbers";
  EXPECT_EQ(said[1].request_id, 513);
  pose_correction_t answer{};
  answer.utime = ToUtime(clock_.Now());
  answer.request_id = 513;
  corrections_.Publish(answer);
  Tick(seconds(1));
  EXPECT_TRUE(places_.Drain().empty());
}

TEST_F(PageOrdersTest, AnAimIsSaidThreeTimes) {
  ASSERT_TRUE(dut_.Take(AimOrder{0.5, 0, {}, {}, {}}, now_));
  for (int i = 0; i < 5; ++i) Tick(seconds(1));
  EXPECT_EQ(aims_.Drain().size(), 3u);
}

TEST_F(PageOrdersTest, WhoAcknowledgedIsSaid) {
  ASSERT_TRUE(dut_.Take(AlarmSeen{"head", 5}, "anna", now_));
  Tick({});
  const auto said = acks_.Drain();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].by, "anna");
}

TEST_F(PageOrdersTest, OfWhatNobodyHasToldNoWishIsTaken) {
  EXPECT_FALSE(dut_.Take(ProcessWish{ProcessWish::Kind::kRestart, "onboard-robot", 0}));
  EXPECT_FALSE(dut_.Take(ParameterWish{ParameterWish::Kind::kSet, "robot", "drive.blocked_s", 1}));
}

TEST(PageOrderRightsTest, AnybodyMayStopAndLookAndOnlyADriverAnythingElse) {
  EXPECT_FALSE(NeedsDriver(StopOrder{}));
  EXPECT_FALSE(NeedsDriver(ListenWish{}));
  EXPECT_TRUE(NeedsDriver(StickReport{}));
  EXPECT_TRUE(NeedsDriver(MissionOrder{}));
  EXPECT_TRUE(NeedsDriver(PlaceOrder{}));
  EXPECT_TRUE(NeedsDriver(AimOrder{}));
  EXPECT_TRUE(NeedsDriver(AlarmSeen{}));
  EXPECT_TRUE(NeedsDriver(ParameterWish{}));
  EXPECT_TRUE(NeedsDriver(ProcessWish{}));
}

TEST(PageOrderRightsTest, WhatChangesSomethingIsWrittenDown) {
  using Wish = ParameterWish::Kind;
  EXPECT_TRUE(IsOrder(StopOrder{}));
  EXPECT_TRUE(IsOrder(MissionOrder{}));
  EXPECT_TRUE(IsOrder(PlaceOrder{}));
  EXPECT_TRUE(IsOrder(ProcessWish{ProcessWish::Kind::kRestart, "", 0}));
  EXPECT_FALSE(IsOrder(ProcessWish{ProcessWish::Kind::kLog, "", 0}));
  EXPECT_TRUE(IsOrder(ParameterWish{Wish::kSet, "", "", 0}));
  EXPECT_FALSE(IsOrder(ParameterWish{Wish::kRead, "", "", 0}));
  EXPECT_FALSE(IsOrder(StickReport{}));
  EXPECT_FALSE(IsOrder(ListenWish{}));
}

}  // namespace
}  // namespace priamos::console
