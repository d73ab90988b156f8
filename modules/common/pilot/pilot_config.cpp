#include "common/pilot/pilot_config.hpp"

#include <algorithm>
#include <cmath>

namespace priamos {

void AxisUse::Describe(Archive& a) {
  a.Choice("axis", axis, kAxisNames, "axis of the stick");
  a.Flag("inverted", inverted, "the other way round");
}

void AxisShape::Describe(Archive& a) {
  a.Number("dead_band", dead_band, {"-", 0, 0.5, "part of the full deflection in which nothing is wished"});
  a.Number("expo", expo, {"-", 0, 1, "0: proportional, 1: cubic, fine near the middle"});
}

double AxisShape::operator()(double deflection) const {
  const double size = std::min(std::abs(deflection), 1.0);
  if (!(size > dead_band)) return 0;  // also for NaN
  const double beyond = (size - dead_band) / (1 - dead_band);
  return std::copysign((1 - expo) * beyond + expo * beyond * beyond * beyond, deflection);
}

void SpeedRange::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.01, 1.5, "at full deflection, in any direction"});
  a.Number("turn_rad_s", turn_rad_s, {"rad/s", 0.01, 2, "at full deflection"});
}

void ButtonUse::Describe(Archive& a) {
  const auto button = [&a](const char* key, int& value, const char* doc) {
    a.Integer(key, value, {"-", -1, 31, doc});
  };
  button("dead_man", dead_man, "held while driving");
  button("mode", mode, "base or head");
  button("estop", estop, "stops everything; latches");
  button("take_over", take_over, "takes the lease from whoever has it");
  button("range", range, "slow or fast");
  button("rearm", rearm, "held for a while with the stick at rest: the e-stop is lifted");
  if (dead_man < 0) a.Refuse("dead_man", "a button: nothing moves without one");
  if (estop < 0) a.Refuse("estop", "a button: an operator must be able to stop");
}

void BaseAxes::Describe(Archive& a) {
  a.Section("vx", vx, "forward");
  a.Section("vy", vy, "to the left");
  a.Section("turn", turn, "counter-clockwise");
}

void HeadAxes::Describe(Archive& a) {
  a.Number("pan_rad_s", pan_rad_s, {"rad/s", 0.01, 1, "at full deflection"});
  a.Number("tilt_rad_s", tilt_rad_s, {"rad/s", 0.01, 1, "at full deflection"});
  a.Number("vergence_rad_s", vergence_rad_s, {"rad/s", 0.01, 0.5, "at full deflection"});
  a.Number("zoom_step_s", zoom_step_s, {"step/s", 10, 1000, "at full deflection"});
  a.Number("focus_step_s", focus_step_s, {"step/s", 10, 1000, "at full deflection"});
  a.Section("pan", pan, "platform to the left");
  a.Section("tilt", tilt, "platform down");
  a.Section("vergence", vergence, "cameras towards each other");
  a.Section("zoom", zoom, "towards longer focal lengths");
  a.Section("focus", focus, "towards greater distances");
}

void PilotConfig::Describe(Archive& a) {
  a.Number("rate_hz", rate_hz, {"Hz", 8, 50, "commands while the stick is deflected"});
  a.Number("rest_rate_hz", rest_rate_hz,
           {"Hz", 0.5, 10, "commands to stand while the dead-man alone is held"});
  a.Number("time_to_live_s", time_to_live_s, {"s", 0.02, 0.25, "how long the robot may obey one command"});
  a.Number("silence_s", silence_s, {"s", 0.05, 0.5, "a deflected stick that is silent for so long is gone"});
  a.Number("rearm_hold_s", rearm_hold_s, {"s", 0.2, 10, "how long the rearm button must be held"});
  a.Number("status_stale_s", status_stale_s, {"s", 0.5, 10, "an older DRIVE_STATUS does not count"});
  a.Section("shape", shape, "from deflection to wish");
  a.Section("slow", slow, "speed range after the start");
  a.Section("fast", fast, "the other speed range");
  a.Section("buttons", buttons, "numbers of the buttons, -1 for none");
  a.Section("base", base, "axes in base mode");
  a.Section("head", head, "axes in head mode");
  if (time_to_live_s * rate_hz < 2)
    a.Refuse("time_to_live_s", "two periods of rate_hz at least: one command may be lost");
}

}  // namespace priamos
