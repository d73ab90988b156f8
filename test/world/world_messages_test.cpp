#include "world/world_messages.hpp"

#include <gtest/gtest.h>

#include "bus/node.hpp"

namespace priamos::world {
namespace {

const Time kNow = FromUtime(1'234'567'000);

/// Over the wire and back.
template <class Message>
Message Sent(const Message& message) {
  return bus::Decode<Message>(bus::Encode(message));
}

TEST(WorldMessagesTest, WheelCommandKeepsTheOrderOfTheWheels) {
  const PerWheel speed{1, -2, 3, -4};
  EXPECT_EQ(FromMessage(Sent(ToMessage(speed, kNow))), speed);
}

TEST(WorldMessagesTest, HeadCommandKeepsEveryAxis) {
  const HeadSetting setting{0.1, -0.2, {0.03, -0.04}, {500, 600}, {700, 800}};
  const HeadSetting dut = FromMessage(Sent(ToMessage(setting, kNow)));
  EXPECT_EQ(dut.pan_rad, 0.1);
  EXPECT_EQ(dut.tilt_rad, -0.2);
  EXPECT_EQ(dut.vergence_rad, setting.vergence_rad);
  EXPECT_EQ(dut.zoom_step, setting.zoom_step);
  EXPECT_EQ(dut.focus_step, setting.focus_step);
}

TEST(WorldMessagesTest, WheelState) {
  const WheelSample sample{kNow, {{1, -2, 2147483647, -2147483647}, true, true, -9, 12}};
  const WheelSample dut = FromMessage(Sent(ToMessage(sample)));
  EXPECT_EQ(dut.time, kNow);
  EXPECT_EQ(dut.reading.position_ticks, sample.reading.position_ticks);
  EXPECT_TRUE(dut.reading.deadline_stopped);
  EXPECT_TRUE(dut.reading.contested);
  EXPECT_EQ(dut.reading.instance, -9);
  EXPECT_EQ(dut.reading.foreign_commands, 12);
}

TEST(WorldMessagesTest, SonarRanges) {
  SonarSample sample{kNow, {}};
  for (int i = 0; i < kSonars; ++i) sample.ranges_m[static_cast<std::size_t>(i)] = 0.1 * i;
  sample.ranges_m[5] = kNoEcho;
  const SonarSample dut = FromMessage(Sent(ToMessage(sample)));
  EXPECT_EQ(dut.ranges_m, sample.ranges_m);
  EXPECT_EQ(dut.time, kNow);
}

TEST(WorldMessagesTest, HeadState) {
  const HeadSample sample{kNow, {0.1, -0.2, {0.03, -0.04}, {500, 600}, {700, 800}}, true};
  const HeadSample dut = FromMessage(Sent(ToMessage(sample)));
  EXPECT_EQ(dut.counters.zoom_step, sample.counters.zoom_step);
  EXPECT_EQ(dut.counters.tilt_rad, -0.2);
  EXPECT_TRUE(dut.moving);
}

TEST(WorldMessagesTest, TruthAndItsGapsWithinTheMessagesRange) {
  Truth truth;
  truth.time = kNow;
  truth.map_from_base = {1, 2, 0.3};
  truth.velocity = {0.4, -0.5, 0.6};
  truth.gap_m = 0.7;
  truth.min_gap_m = 25;
  truth.contacts = 3;
  truth.axes.pan_rad = 0.8;
  const Truth dut = FromMessage(Sent(ToMessage(truth)));
  EXPECT_EQ(dut.map_from_base.yaw, 0.3);
  EXPECT_EQ(dut.velocity.vy, -0.5);
  EXPECT_EQ(dut.gap_m, 0.7);
  EXPECT_EQ(dut.min_gap_m, 10);
  EXPECT_EQ(dut.contacts, 3);
  EXPECT_EQ(dut.axes.pan_rad, 0.8);
}

TEST(WorldMessagesTest, CameraFrameSaysWhichPictureLiesWhere) {
  const Frame frame{kNow, 42, kRightCamera, {768, 576, std::vector<std::uint8_t>(768 * 576)}};
  const camera_frame_t dut = Sent(ToMessage(frame, 5));
  EXPECT_EQ(dut.utime_exposure, ToUtime(kNow));
  EXPECT_EQ(dut.frame_id, 42);
  EXPECT_EQ(dut.camera, 1);
  EXPECT_EQ(dut.slot, 5);
  EXPECT_EQ(dut.width_px, 768);
  EXPECT_EQ(dut.height_px, 576);
}

}  // namespace
}  // namespace priamos::world
