#include "head/core/motion/ahead_watch.hpp"

#include <algorithm>

#include "common/geometry.hpp"

namespace priamos::head {

void AheadWatchConfig::Describe(Archive& a) {
  a.Flag("ahead", ahead, "look ahead for what stands on the floor while the base follows a path");
  a.Number("tilt_deg", tilt_deg, {"deg", -45, 45, "of these glances, positive looks down"});
  a.Number("max_pan_deg", max_pan_deg, {"deg", 0, 90, "of these glances, to where the base drives"});
  a.Number("every_s", every_s, {"s", 0, 60, "from the end of a glance to the beginning of the next one"});
  a.Number("idle_s", idle_s, {"s", 0, 60, "time after a look from near, or an operator's order"});
}

HeadSetting AheadWatch::SettingFrom(HeadSetting base, double bearing_rad) const {
  const double most = Radians(config_.max_pan_deg);
  base.pan_rad = std::clamp(bearing_rad, -most, most);
  base.tilt_rad = Radians(config_.tilt_deg);
  return base;
}

}  // namespace priamos::head
