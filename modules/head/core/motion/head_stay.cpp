#include "head/core/motion/head_stay.hpp"

namespace priamos::head {

bool MayStay(const HeadModel& head, const TwoSettings& settings, const LandmarkModel& model,
             const LandmarkPrediction& expected, int side, const AimConfig& aim, const TiltConfig& look_up) {
  constexpr double kWorthTurning_px = 60;
  const auto level_edges = [&](const HeadSetting& setting) {
    return LevelEdgesShown(head, setting, model, expected.base_from_landmark, look_up);
  };
  const auto outside_px = [&](const HeadSetting& setting) {
    return SideOutsideBy(head, setting, model, expected, side, aim);
  };
  const auto& [here, best] = settings;
  if (here.tilt_rad < best.tilt_rad && level_edges(best) == 0) return true;
  return level_edges(here) >= level_edges(best) && outside_px(here) < outside_px(best) + kWorthTurning_px;
}

}  // namespace priamos::head
