#pragma once

#include <string>

#include "common/pilot/pilot.hpp"
#include "lcmtypes/channels.hpp"
#include "teleop/core/terminal_view.hpp"

namespace priamos::teleop {

/// Who this process is in its messages.
struct Sender {
  int session = 0;   ///< 0..255
  int sequence = 0;  ///< number of the newest command, 0..65535
};

drive_command_t ToMessage(const Twist2& wish, const Sender& sender, double time_to_live_s, Time now);
head_drive_t ToMessage(const HeadRates& wish, const Sender& sender, double time_to_live_s, Time now);
lease_request_t ToMessage(PilotOutput::Lease wish, const Sender& sender, Time now);
estop_t ToMessage(PilotOutput::Estop action, Time now);

/// What DRIVE_STATUS means to teleop process `session`.
RobotView FromMessage(const drive_status_t& message, int session);
/// Puts it into words. Numbers that no version of the robot sends become "?".
void Describe(const drive_status_t& message, int session, TerminalView& view);

}  // namespace priamos::teleop
