#include "console/console_messages.hpp"

namespace priamos::console {
namespace {

constexpr auto kSelf = lease_request_t::CONSOLE;

}  // namespace

drive_command_t ToMessage(const Twist2& wish, const Sender& sender, double time_to_live_s, Time now) {
  drive_command_t message{};
  message.utime = ToUtime(now);
  message.driver = kSelf;
  message.session = static_cast<std::int16_t>(sender.session);
  message.sequence = sender.sequence;
  message.time_to_live_s = time_to_live_s;
  message.vx_m_s = wish.vx;
  message.vy_m_s = wish.vy;
  message.wz_rad_s = wish.wz;
  return message;
}

head_drive_t ToMessage(const HeadRates& wish, const Sender& sender, double time_to_live_s, Time now) {
  head_drive_t message{};
  message.utime = ToUtime(now);
  message.session = static_cast<std::int16_t>(sender.session);
  message.sequence = sender.sequence;
  message.time_to_live_s = time_to_live_s;
  message.pan_rad_s = wish.pan_rad_s;
  message.tilt_rad_s = wish.tilt_rad_s;
  message.vergence_rad_s = wish.vergence_rad_s;
  message.zoom_step_s = wish.zoom_step_s;
  message.focus_step_s = wish.focus_step_s;
  return message;
}

lease_request_t ToMessage(PilotOutput::Lease wish, const Sender& sender, Time now) {
  lease_request_t message{};
  message.utime = ToUtime(now);
  message.driver = kSelf;
  message.session = static_cast<std::int16_t>(sender.session);
  message.action =
      wish == PilotOutput::Lease::kTakeOver ? lease_request_t::TAKE_OVER : lease_request_t::ACQUIRE;
  return message;
}

estop_t ToMessage(PilotOutput::Estop action, Time now) {
  estop_t message{};
  message.utime = ToUtime(now);
  message.action = action == PilotOutput::Estop::kStop ? estop_t::STOP : estop_t::REARM;
  message.driver = kSelf;
  return message;
}

mission_command_t ToMessage(const MissionOrder& order, Time now) {
  mission_command_t message{};
  message.utime = ToUtime(now);
  message.mission = order.abort ? mission_command_t::ABORT : mission_command_t::PASS_DOOR;
  message.landmark_id = static_cast<std::int16_t>(order.landmark_id);
  return message;
}

link_request_t ToMessage(const WantedChannels::Request& request, Time now) {
  link_request_t message{};
  message.utime = ToUtime(now);
  message.channel = request.channel;
  message.hold_s = request.hold_s;
  return message;
}

RobotView FromMessage(const drive_status_t& message, int session) {
  RobotView view;
  view.heard = FromUtime(message.utime);
  view.estop = message.estop;
  const bool mine = message.driver == kSelf && message.session == session;
  view.lease = message.driver == lease_request_t::NOBODY ? RobotView::Lease::kFree
               : mine                                    ? RobotView::Lease::kMine
                                                         : RobotView::Lease::kOther;
  return view;
}

Time ValidTime(const nlohmann::ordered_json& message, Time arrival, Duration longest) {
  for (const char* field : {"utime", "utime_exposure"}) {
    const auto it = message.find(field);
    if (it == message.end() || !it->is_number_integer()) continue;
    const std::int64_t utime = it->get<std::int64_t>(), now = ToUtime(arrival);
    if (utime <= now && utime >= now - longest.count()) return FromUtime(utime);
  }
  return arrival;
}

}  // namespace priamos::console
