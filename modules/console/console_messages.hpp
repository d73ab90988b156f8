#pragma once

#include "common/pilot/pilot.hpp"
#include "console/core/browser_message.hpp"
#include "console/core/wanted_channels.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::console {

/// Who this process is in its commands.
struct Sender {
  int session = 0;   ///< 0..255
  int sequence = 0;  ///< number of the newest command, 0..65535
};

/// How well a person can tell on the plan where the robot stands, one sigma.
struct PlaceSigma {
  double position_m = 0.15;
  double yaw_deg = 5;
};

drive_command_t ToMessage(const Twist2& wish, const Sender& sender, double time_to_live_s, Time now);
head_drive_t ToMessage(const HeadRates& wish, const Sender& sender, double time_to_live_s, Time now);
lease_request_t ToMessage(PilotOutput::Lease wish, const Sender& sender, Time now);
estop_t ToMessage(PilotOutput::Estop action, Time now);
mission_command_t ToMessage(const MissionOrder& order, Time now);
head_aim_t ToMessage(const AimOrder& order, Time now);
/// `by`: who has taken note; cut to what the message holds.
alarm_ack_t ToMessage(const AlarmSeen& seen, const std::string& by, Time now);
pose_reset_t ToMessage(const PlaceOrder& order, int request_id, const PlaceSigma& known, Time now);
link_request_t ToMessage(const WantedChannels::Request& request, Time now);

/// What DRIVE_STATUS means to the console of `session`.
RobotView FromMessage(const drive_status_t& message, int session);

}  // namespace priamos::console
