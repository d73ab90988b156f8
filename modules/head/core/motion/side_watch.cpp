#include "head/core/motion/side_watch.hpp"

#include "common/geometry.hpp"

namespace priamos::head {

void SideWatchConfig::Describe(Archive& a) {
  a.Flag("corridors", corridors, "look for doors to both sides while the base follows a corridor");
  a.Number("pan_deg", pan_deg, {"deg", 5, 90, "to either side in turn"});
  a.Number("tilt_deg", tilt_deg, {"deg", -45, 45, "of these glances, positive looks down"});
  a.Integer("zoom_step", zoom_step, {"step", 0, 2000, "zoom motors for these glances"});
  a.Number("every_s", every_s, {"s", 0, 60, "from the end of a glance to the beginning of the next one"});
  a.Number("idle_s", idle_s, {"s", 0, 60, "time after a look from near, or an operator's order"});
}

std::optional<double> SideWatch::Step(bool needed, bool glancing, bool follows, Time now) {
  if (!GlanceRhythm::Step(needed, glancing, follows && config_.corridors, now)) return std::nullopt;
  side_ = -side_;
  return side_ * Radians(config_.pan_deg);
}

HeadSetting SideWatch::SettingAt(double pan_rad, HeadSetting base) const {
  base.pan_rad = pan_rad;
  base.tilt_rad = Radians(config_.tilt_deg);
  base.zoom_step = {config_.zoom_step, config_.zoom_step};
  return base;
}

}  // namespace priamos::head
