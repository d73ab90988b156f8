#include "teleop/teleop_messages.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace priamos::teleop {
namespace {

constexpr std::array<const char*, 6> kDoing{"idle",  "follows a path", "arrived",
                                            "holds", "blocked",        "operated"};
constexpr std::array<const char*, 11> kLimits{"nothing",         "sonars",          "pose lost",
                                              "encoders silent", "sonars silent",   "wheels stuck",
                                              "head is silent",  "radio link down", "operator silent",
                                              "lease lost",      "e-stop"};
constexpr std::array<const char*, 6> kRefusals{"",        "no lease",     "out of order",
                                               "too old", "out of range", "let the stick go first"};
constexpr std::array<const char*, 4> kDrivers{"free", "planner", "console", "teleop"};

template <std::size_t N>
std::string Word(const std::array<const char*, N>& words, int code) {
  return code >= 0 && code < static_cast<int>(N) ? words[static_cast<std::size_t>(code)] : "?";
}

}  // namespace

drive_command_t ToMessage(const Twist2& wish, const Sender& sender, double time_to_live_s, Time now) {
  drive_command_t message{};
  message.utime = ToUtime(now);
  message.driver = lease_request_t::TELEOP;
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
  message.driver = lease_request_t::TELEOP;
  message.session = static_cast<std::int16_t>(sender.session);
  message.action =
      wish == PilotOutput::Lease::kTakeOver ? lease_request_t::TAKE_OVER : lease_request_t::ACQUIRE;
  return message;
}

estop_t ToMessage(PilotOutput::Estop action, Time now) {
  estop_t message{};
  message.utime = ToUtime(now);
  message.action = action == PilotOutput::Estop::kStop ? estop_t::STOP : estop_t::REARM;
  message.driver = lease_request_t::TELEOP;
  return message;
}

RobotView FromMessage(const drive_status_t& message, int session) {
  RobotView view;
  view.heard = FromUtime(message.utime);
  view.estop = message.estop;
  view.refused = message.refused;
  view.refuses_motion = message.refusal == drive_status_t::REFUSED_NOT_AT_REST;
  const bool teleop = message.driver == lease_request_t::TELEOP;
  view.lease = message.driver == lease_request_t::NOBODY ? RobotView::Lease::kFree
               : teleop && message.session == session    ? RobotView::Lease::kMine
                                                         : RobotView::Lease::kOther;
  return view;
}

void Describe(const drive_status_t& message, int session, TerminalView& view) {
  const bool mine = FromMessage(message, session).lease == RobotView::Lease::kMine;
  view.lease = mine ? "ours" : Word(kDrivers, message.driver);
  if (!mine && message.driver == lease_request_t::TELEOP)
    view.lease = fmt::format("another teleop ({})", message.session);
  view.doing = Word(kDoing, message.mode);
  view.limit = Word(kLimits, message.limit);
  view.allowed = std::isfinite(message.allowed) ? message.allowed : 0;
  view.speed_m_s = std::isfinite(message.speed_m_s) ? message.speed_m_s : 0;
  view.nearest_m = std::isfinite(message.nearest_m) ? message.nearest_m : -1;
  view.estop = message.estop;
  view.refused = message.refused;
  view.refusal = Word(kRefusals, message.refusal);
}

}  // namespace priamos::teleop
