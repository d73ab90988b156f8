#include "console/console_messages.hpp"

namespace priamos::console {
namespace {

using Kind = MissionOrder::Kind;

constexpr auto kSelf = lease_request_t::CONSOLE;
constexpr std::size_t kLongestName = 40;  ///< alarm_ack_t

std::int8_t MissionOf(Kind kind) {
  switch (kind) {
    case Kind::kPause:
      return mission_command_t::PAUSE;
    case Kind::kResume:
      return mission_command_t::RESUME;
    case Kind::kCancel:
      return mission_command_t::CANCEL;
    case Kind::kPassDoor:
      return mission_command_t::PASS_DOOR;
    case Kind::kGoto:
      return mission_command_t::GOTO;
    case Kind::kCorridor:
      return mission_command_t::CORRIDOR;
    case Kind::kExplore:
      return mission_command_t::EXPLORE;
    case Kind::kLocate:
      return mission_command_t::LOCATE;
    case Kind::kPatrol:
      return mission_command_t::RUN;
    default:
      return mission_command_t::ABORT;
  }
}

mission_step_t StepTo(const Target& place) {
  mission_step_t step{};
  step.mission = mission_command_t::GOTO;
  step.x_m = place.map_from_base.x;
  step.y_m = place.map_from_base.y;
  step.yaw_rad = place.map_from_base.yaw;
  step.turn = place.turn;
  return step;
}

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
  message.mission = MissionOf(order.kind);
  message.landmark_id = static_cast<std::int16_t>(order.landmark_id);
  if (order.goal) {
    message.x_m = order.goal->map_from_base.x;
    message.y_m = order.goal->map_from_base.y;
    message.yaw_rad = order.goal->map_from_base.yaw;
    message.turn = order.goal->turn;
  }
  message.distance_m = static_cast<float>(order.distance_m);
  message.order_id = order.order_id;
  if (order.kind != MissionOrder::Kind::kPatrol) return message;
  message.rounds = static_cast<std::int16_t>(order.rounds);
  for (const Target& place : order.places) message.steps.push_back(StepTo(place));
  message.n_steps = static_cast<std::int8_t>(message.steps.size());
  return message;
}

head_aim_t ToMessage(const AimOrder& order, Time now) {
  head_aim_t message{};
  message.utime = ToUtime(now);
  message.pan_rad = order.pan_rad;
  message.tilt_rad = order.tilt_rad;
  message.vergence_rad = order.vergence_rad.value_or(-1);
  message.zoom_step = static_cast<std::int16_t>(order.zoom_step.value_or(-1));
  message.focus_step = static_cast<std::int16_t>(order.focus_step.value_or(-1));
  return message;
}

alarm_ack_t ToMessage(const AlarmSeen& seen, const std::string& by, Time now) {
  alarm_ack_t message{};
  message.utime = ToUtime(now);
  message.source = seen.source;
  message.utime_alarm = seen.utime;
  message.by = by.substr(0, kLongestName);
  return message;
}

pose_reset_t ToMessage(const PlaceOrder& order, int request_id, const PlaceSigma& known, Time now) {
  pose_reset_t message{};
  message.utime = ToUtime(now);
  message.request_id = request_id;
  message.x_m = order.map_from_base.x;
  message.y_m = order.map_from_base.y;
  message.yaw_rad = order.map_from_base.yaw;
  message.sigma_m = known.position_m;
  message.sigma_yaw_rad = Radians(known.yaw_deg);
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
  view.refused = message.refused;
  view.refuses_motion = message.refusal == drive_status_t::REFUSED_NOT_AT_REST;
  const bool mine = message.driver == kSelf && message.session == session;
  view.lease = message.driver == lease_request_t::NOBODY ? RobotView::Lease::kFree
               : mine                                    ? RobotView::Lease::kMine
                                                         : RobotView::Lease::kOther;
  return view;
}

}  // namespace priamos::console
