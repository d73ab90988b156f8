#include "head/core/motion/head_aim.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/robot/robot_drawing.hpp"

namespace priamos::head {
namespace {

double Within(double value, double most) {
  return std::clamp(value, -most, most);
}

bool IsCredible(const HeadAim& aim) {
  return std::isfinite(aim.pan_rad) && std::isfinite(aim.tilt_rad) &&
         std::isfinite(aim.vergence_rad.value_or(0));
}

HeadSetting SettingOf(const HeadAim& aim, const HeadSetting& here) {
  HeadSetting setting = here;
  setting.pan_rad = Within(aim.pan_rad, kDrawnHead.most_pan_rad);
  setting.tilt_rad = Within(aim.tilt_rad, kDrawnHead.most_tilt_rad);
  for (std::size_t i = 0; i < 2; ++i) {
    const double inward = i == 0 ? -1 : 1;  // the left camera turns right, the right one left
    if (aim.vergence_rad)
      setting.vergence_rad[i] = Within(inward * *aim.vergence_rad, kDrawnHead.most_vergence_rad);
    if (aim.zoom_step) setting.zoom_step[i] = std::clamp(*aim.zoom_step, 0, kDrawnHead.most_step);
    if (aim.focus_step) setting.focus_step[i] = std::clamp(*aim.focus_step, 0, kDrawnHead.most_step);
  }
  return setting;
}

}  // namespace

bool AimKeeper::Take(const HeadAim& aim, Time now) {
  if (newest_ && aim.time == *newest_) return false;
  if (!IsCredible(aim) || now > aim.time + kLongestLife || (newest_ && aim.time < *newest_)) {
    ++refused_;
    return false;
  }
  newest_ = aim.time;
  waiting_ = aim;
  return true;
}

std::optional<HeadSetting> AimKeeper::Next(const HeadSetting& here, Time now) {
  const auto aim = std::exchange(waiting_, std::nullopt);
  if (!aim || now > aim->time + kLongestLife) return std::nullopt;
  aimed_ = now;
  return SettingOf(*aim, here);
}

}  // namespace priamos::head
