#include "world/world_messages.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {
namespace {

constexpr std::size_t kLongestThing = 60;  ///< world_touch_t

template <class Message>
void SetAxes(Message& message, const HeadSetting& setting) {
  message.pan_rad = setting.pan_rad;
  message.tilt_rad = setting.tilt_rad;
  for (std::size_t i = 0; i < 2; ++i) {
    message.vergence_rad[i] = setting.vergence_rad[i];
    message.zoom_step[i] = static_cast<std::int16_t>(std::lround(setting.zoom_step[i]));
    message.focus_step[i] = static_cast<std::int16_t>(std::lround(setting.focus_step[i]));
  }
}

template <class Message>
HeadSetting AxesOf(const Message& message) {
  HeadSetting setting;
  setting.pan_rad = message.pan_rad;
  setting.tilt_rad = message.tilt_rad;
  for (std::size_t i = 0; i < 2; ++i) {
    setting.vergence_rad[i] = message.vergence_rad[i];
    setting.zoom_step[i] = message.zoom_step[i];
    setting.focus_step[i] = message.focus_step[i];
  }
  return setting;
}

}  // namespace

PerWheel FromMessage(const wheel_command_t& message) {
  PerWheel speed;
  std::copy_n(message.speed_rad_s, 4, speed.begin());
  return speed;
}

wheel_command_t ToMessage(const PerWheel& speed_rad_s, Time now, std::int32_t instance) {
  wheel_command_t message;
  message.utime = ToUtime(now);
  message.instance = instance;
  std::copy_n(speed_rad_s.begin(), 4, message.speed_rad_s);
  return message;
}

HeadSetting FromMessage(const head_command_t& message) {
  return AxesOf(message);
}

head_command_t ToMessage(const HeadSetting& setting, Time now) {
  head_command_t message;
  message.utime = ToUtime(now);
  SetAxes(message, setting);
  return message;
}

wheel_state_t ToMessage(const WheelSample& sample) {
  wheel_state_t message;
  message.utime = ToUtime(sample.time);
  std::copy_n(sample.reading.position_ticks.begin(), 4, message.position_ticks);
  message.deadline_stopped = sample.reading.deadline_stopped;
  message.contested = sample.reading.contested;
  message.instance = sample.reading.instance;
  message.foreign_commands = sample.reading.foreign_commands;
  return message;
}

WheelSample FromMessage(const wheel_state_t& message) {
  WheelSample sample;
  sample.time = FromUtime(message.utime);
  std::copy_n(message.position_ticks, 4, sample.reading.position_ticks.begin());
  sample.reading.deadline_stopped = message.deadline_stopped != 0;
  sample.reading.contested = message.contested != 0;
  sample.reading.instance = message.instance;
  sample.reading.foreign_commands = message.foreign_commands;
  return sample;
}

motor_current_t CurrentsOf(const TouchSample& sample) {
  motor_current_t message;
  message.utime = ToUtime(sample.time);
  std::copy_n(sample.current_a.begin(), 4, message.current_a);
  return message;
}

bumper_t BumperOf(const TouchSample& sample) {
  bumper_t message;
  message.utime = ToUtime(sample.time);
  message.pressed = sample.pressed;
  return message;
}

sonar_ranges_t ToMessage(const SonarSample& sample) {
  sonar_ranges_t message;
  message.utime = ToUtime(sample.time);
  std::copy_n(sample.ranges_m.begin(), kSonars, message.range_m);
  return message;
}

SonarSample FromMessage(const sonar_ranges_t& message) {
  SonarSample sample;
  sample.time = FromUtime(message.utime);
  std::copy_n(message.range_m, kSonars, sample.ranges_m.begin());
  return sample;
}

head_state_t ToMessage(const HeadSample& sample) {
  head_state_t message;
  message.utime = ToUtime(sample.time);
  SetAxes(message, sample.counters);
  message.moving = sample.moving;
  return message;
}

HeadSample FromMessage(const head_state_t& message) {
  return {FromUtime(message.utime), AxesOf(message), message.moving != 0};
}

world_truth_t ToMessage(const Truth& truth) {
  world_truth_t message;
  message.utime = ToUtime(truth.time);
  message.x_m = truth.map_from_base.x;
  message.y_m = truth.map_from_base.y;
  message.yaw_rad = WrapAngle(truth.map_from_base.yaw);
  message.vx_m_s = truth.velocity.vx;
  message.vy_m_s = truth.velocity.vy;
  message.wz_rad_s = truth.velocity.wz;
  message.gap_m = std::min(truth.gap_m, 10.0);
  message.min_gap_m = std::min(truth.min_gap_m, 10.0);
  message.contacts = truth.contacts;
  message.pan_rad = truth.axes.pan_rad;
  return message;
}

world_touch_t ToMessage(const TouchEvent& touch) {
  world_touch_t message;
  message.utime = ToUtime(touch.time);
  message.kind = static_cast<std::int8_t>(touch.kind);
  message.thing = touch.thing.substr(0, kLongestThing);
  message.x_m = touch.in_base.x();
  message.y_m = touch.in_base.y();
  return message;
}

Truth FromMessage(const world_truth_t& message) {
  Truth truth;
  truth.time = FromUtime(message.utime);
  truth.map_from_base = {message.x_m, message.y_m, message.yaw_rad};
  truth.velocity = {message.vx_m_s, message.vy_m_s, message.wz_rad_s};
  truth.gap_m = message.gap_m;
  truth.min_gap_m = message.min_gap_m;
  truth.contacts = message.contacts;
  truth.axes.pan_rad = message.pan_rad;
  return truth;
}

camera_frame_t ToMessage(const Frame& frame, int slot) {
  camera_frame_t message;
  message.utime_exposure = ToUtime(frame.exposure_middle);
  message.frame_id = frame.frame_id;
  message.camera = static_cast<std::int8_t>(frame.camera);
  message.slot = static_cast<std::int16_t>(slot);
  message.width_px = static_cast<std::int16_t>(frame.image.width);
  message.height_px = static_cast<std::int16_t>(frame.image.height);
  return message;
}

}  // namespace priamos::world
