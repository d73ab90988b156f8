#include "cli/terminal/where_text.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "cli/scenario/mission_order.hpp"
#include "common/geometry.hpp"
#include "planner/planner_messages.hpp"
#include "priamos/lease_request_t.hpp"

namespace priamos::cli {
namespace {

using nlohmann::ordered_json;

std::string_view ModeName(int mode) {
  constexpr std::array<std::string_view, 6> kNames{"IDLE",    "FOLLOWING", "ARRIVED",
                                                   "HOLDING", "BLOCKED",   "OPERATED"};
  return mode >= 0 && mode < int(kNames.size()) ? kNames[std::size_t(mode)] : "UNKNOWN";
}

std::string_view DriverName(int driver) {
  switch (driver) {
    case lease_request_t::PLANNER:
      return "planner";
    case lease_request_t::CONSOLE:
      return "console";
    case lease_request_t::TELEOP:
      return "teleop";
    default:
      return "nobody";
  }
}

double Age(std::int64_t utime, Time now) {
  return Seconds(now - FromUtime(utime));
}

std::string PoseLines(const std::optional<pose_t>& heard, Time now) {
  if (!heard) return "at       not heard: no POSE\n";
  const pose_t& p = *heard;
  return fmt::format(
      "at       x {:.2f} m, y {:.2f} m, heading {:.1f} deg in the map, {:.2f} s ago\n"
      "1 sigma  {:.1f} cm in x, {:.1f} cm in y, {:.2f} deg\n"
      "moves    {:.2f} m/s forward, {:.2f} m/s to the left, {:.1f} deg/s\n",
      p.x_m, p.y_m, Degrees(p.yaw_rad), Age(p.utime, now), 100 * p.sigma_x_m, 100 * p.sigma_y_m,
      Degrees(p.sigma_yaw_rad), p.vx_m_s, p.vy_m_s, Degrees(p.wz_rad_s));
}

std::string DriveLines(const std::optional<drive_status_t>& heard, Time now) {
  if (!heard) return "does     not heard: no DRIVE_STATUS\n";
  const drive_status_t& d = *heard;
  const std::string_view limit = planner::DriveLimitText(d.limit);
  const std::string path = d.mode == drive_status_t::FOLLOWING
                               ? fmt::format(", {:.2f} m to go on path {}", d.remaining_m, d.path_id)
                               : "";
  return fmt::format("does     {}{}; lease: {}; {:.2f} s ago\n", ModeName(d.mode), path, DriverName(d.driver),
                     Age(d.utime, now)) +
         fmt::format("limit    {}; {:.0f} % of the wanted speed{}\n", limit.empty() ? "none" : limit,
                     100 * d.allowed, d.estop ? "; E-STOP is latched" : "");
}

ordered_json ToJson(const pose_t& p, Time now) {
  return {{"x_m", p.x_m},
          {"y_m", p.y_m},
          {"yaw_rad", p.yaw_rad},
          {"sigma_x_m", p.sigma_x_m},
          {"sigma_y_m", p.sigma_y_m},
          {"sigma_yaw_rad", p.sigma_yaw_rad},
          {"vx_m_s", p.vx_m_s},
          {"vy_m_s", p.vy_m_s},
          {"wz_rad_s", p.wz_rad_s},
          {"age_s", Age(p.utime, now)}};
}

ordered_json ToJson(const drive_status_t& d, Time now) {
  return {{"mode", ModeName(d.mode)},     {"limit", planner::DriveLimitText(d.limit)},
          {"allowed", d.allowed},         {"path_id", d.path_id},
          {"remaining_m", d.remaining_m}, {"driver", DriverName(d.driver)},
          {"estop", d.estop != 0},        {"age_s", Age(d.utime, now)}};
}

ordered_json ToJson(const mission_status_t& m, Time now) {
  return {{"phase", PhaseName(m.phase)}, {"text", m.text}, {"age_s", Age(m.utime, now)}};
}

template <class T>
ordered_json OrNull(const std::optional<T>& message, Time now) {
  return message ? ToJson(*message, now) : ordered_json(nullptr);
}

}  // namespace

std::string WhereText(const Whereabouts& where, Time now) {
  const std::string mission =
      where.mission ? fmt::format("{}: {}", PhaseName(where.mission->phase), where.mission->text)
                    : "not heard: no planner on this bus";
  return PoseLines(where.pose, now) + DriveLines(where.drive, now) + fmt::format("mission  {}\n", mission);
}

ordered_json WhereJson(const Whereabouts& where, Time now) {
  return {{"pose", OrNull(where.pose, now)},
          {"drive", OrNull(where.drive, now)},
          {"mission", OrNull(where.mission, now)}};
}

}  // namespace priamos::cli
