#include "console/log_on_bus.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "bus/own_types.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "lcmtypes/channels.hpp"
#include "test/bus/schema/encoding.hpp"

namespace priamos::console {
namespace {

constexpr std::int64_t kThen_us = 1'000'000'000;

/// A bus onto which the test plays poses of long ago, and what the station was told of them.
class LogOnBusTest : public testing::Test, public LogListener {
 protected:
  void Send(double time_s, const std::string& channel = "POSE") {
    pose_t pose{};
    pose.utime = kThen_us + static_cast<std::int64_t>(time_s * 1e6);
    bus_.Publish(channel, bus::Encode(pose));
    Play();
  }
  void Play(double seconds = 0) {
    now_ += FromSeconds(seconds);
    dut_.Play(now_, *this);
  }
  void Heard(const std::string& channel, std::span<const std::byte>, Time time) override {
    heard_.emplace_back(channel, static_cast<double>(ToUtime(time) - kThen_us) * 1e-6);
  }
  void Begun() override { ++begun_; }

  const bus::Schema schema_ = bus::OwnTypes();
  bus::LcmBus bus_{"memq://"};
  LogOnBus dut_{bus_, schema_};
  Time now_ = FromUtime(5'000'000'000);
  std::vector<std::pair<std::string, double>> heard_;
  int begun_ = 0;
};

TEST_F(LogOnBusTest, ItsTimeIsThatOfTheNewestMessage) {
  Send(1);
  Send(1.5);
  Send(1.4, "POSE_CORRECTION_OLD");
  EXPECT_EQ(dut_.time(), FromUtime(kThen_us + 1'500'000));
  EXPECT_EQ(dut_.State()["position_s"], 0.5);
  EXPECT_THAT(heard_, testing::ElementsAre(std::pair("POSE", 1.0), std::pair("POSE", 1.5)));
}

TEST_F(LogOnBusTest, WhatRunsOnTheSameLogIsNotTheLog) {
  Send(1);
  Send(90, "REPLAYED_POSE");
  EXPECT_EQ(heard_.size(), 1u);
  EXPECT_EQ(dut_.State()["position_s"], 0.0);
}

TEST_F(LogOnBusTest, BytesThatAreNoMessageDoNoHarm) {
  bus_.Publish("POSE", std::vector<std::byte>(20));
  Play();
  EXPECT_TRUE(heard_.empty()) << "nothing is known of the log's time";
  EXPECT_EQ(dut_.State()["position_s"], 0.0);
}

TEST_F(LogOnBusTest, ItsSpeedIsMeasuredAndItStandsWhenNothingComes) {
  Send(0);
  Play(1);
  for (int i = 1; i <= 20; ++i) {
    Play(0.1);
    Send(0.4 * i);
  }
  EXPECT_NEAR(dut_.State()["speed"].get<double>(), 4, 0.5);
  EXPECT_EQ(dut_.State()["paused"], false);
  Play(1);
  Play(1);
  EXPECT_EQ(dut_.State()["paused"], true);
}

TEST_F(LogOnBusTest, PlayedAgainItBeginsAnew) {
  for (int i = 0; i < 100; ++i) Send(0.2 * i);
  for (int i = 0; i < 60; ++i) Send(0.02 * i);
  EXPECT_EQ(begun_, 1);
  EXPECT_EQ(std::count(heard_.begin(), heard_.end(), std::pair<std::string, double>("POSE", 0.0)), 2)
      << "the station hears its first message again";
  EXPECT_NEAR(Seconds(dut_.time() - FromUtime(kThen_us)), 0.02 * 59, 1e-6);
}

}  // namespace
}  // namespace priamos::console
