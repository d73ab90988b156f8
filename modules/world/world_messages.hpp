#pragma once

#include "lcmtypes/channels.hpp"
#include "world/core/simulation.hpp"

namespace priamos::world {

PerWheel FromMessage(const wheel_command_t& message);
HeadSetting FromMessage(const head_command_t& message);

wheel_state_t ToMessage(const WheelSample& sample);
motor_current_t CurrentsOf(const TouchSample& sample);
bumper_t BumperOf(const TouchSample& sample);
sonar_ranges_t ToMessage(const SonarSample& sample);
head_state_t ToMessage(const HeadSample& sample);
/// Gaps beyond the message's range (nothing near) are sent as its end, 10 m.
world_truth_t ToMessage(const Truth& truth);
/// A name too long for the message is cut off.
world_touch_t ToMessage(const TouchEvent& touch);
/// Notice of a picture; `slot` is where the picture lies in the frame store.
camera_frame_t ToMessage(const Frame& frame, int slot);

/// The opposite direction, for tests and tools that stand in for the robot.
wheel_command_t ToMessage(const PerWheel& speed_rad_s, Time now, std::int32_t instance = 0);
head_command_t ToMessage(const HeadSetting& setting, Time now);
WheelSample FromMessage(const wheel_state_t& message);
SonarSample FromMessage(const sonar_ranges_t& message);
HeadSample FromMessage(const head_state_t& message);
Truth FromMessage(const world_truth_t& message);

}  // namespace priamos::world
