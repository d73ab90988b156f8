#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/pilot/pilot.hpp"

namespace priamos::teleop {

/// What `priamos-teleop --show` draws.
struct TerminalView {
  std::string device;
  Stick stick;
  PilotPhase phase = PilotPhase::kNoDevice;
  PilotMode mode = PilotMode::kBase;
  bool fast = false;
  Twist2 wish;
  HeadRates head_wish;
  ButtonUse buttons;
  std::array<std::string, kAxes> uses{};  ///< what each axis moves in this mode; empty: nothing
  // From DRIVE_STATUS.
  std::optional<double> answer_age_s;  ///< age of the last answer; none before the first
  std::string lease;                   ///< holder of the lease, in words
  std::string doing, limit;            ///< state and limit of the base, in words
  double allowed = 1, speed_m_s = 0, nearest_m = -1;
  bool estop = false;
  int refused = 0;
  std::string refusal;  ///< reason of the newest refusal
};

/// What each axis of the stick moves in `mode`.
std::array<std::string, kAxes> Uses(const PilotConfig& config, PilotMode mode);

/// Text for a terminal of 80 columns, without escape sequences, every line ended. Always as many lines.
std::string Draw(const TerminalView& view);

}  // namespace priamos::teleop
