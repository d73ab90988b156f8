#include "head/core/motion/gaze.hpp"

#include <cmath>

#include "head/core/motion/head_stay.hpp"

namespace priamos::head {
namespace {

/// Of edges beyond a landmark: three have to agree.
constexpr std::size_t kEnoughBeyond = 4;

}  // namespace

HeadSetting SettingFor(const HeadModel& head, const LookWish& wish, const HeadStanding& standing,
                       const GazeConfig& config) {
  const Pose2& map_from_landmark = wish.model.map_from_landmark;
  const LandmarkPrediction expected = PredictAhead(wish.robot, map_from_landmark, config.aim.lead_s);
  const LandmarkPrediction later =
      PredictAhead(wish.robot, map_from_landmark, config.aim.lead_s + config.look_up.ahead_s);
  HeadSetting setting = config.fixed;
  setting.tilt_rad = AimTilt(head, setting, wish.model, expected.base_from_landmark, later.base_from_landmark,
                             config.look_up);
  if (config.lens.choose && standing.here)
    return ChooseLens(head, setting, *standing.here, wish, config.aim, config.lens, config.approach_steps);
  setting.pan_rad = AimPan(head, setting, wish.model, expected, later, wish.side, config.aim);
  const bool stays =
      standing.kept && MayStay(head, {*standing.kept, setting}, wish.model,
                               Predict(wish.robot, map_from_landmark), wish.side, config.aim, config.look_up);
  return stays ? *standing.kept : setting;
}

HeadSetting SettingBeyond(const HeadModel& head, const LookWish& wish, std::vector<UprightTarget> beyond,
                          const GazeConfig& config) {
  const Pose2 base_from_landmark =
      PredictAhead(wish.robot, wish.model.map_from_landmark, config.aim.lead_s).base_from_landmark;
  for (UprightTarget& edge : beyond) edge.at = base_from_landmark * edge.at;
  HeadSetting setting = config.fixed;
  setting.pan_rad = AimFar(head, setting, beyond);
  return setting;
}

double DistanceTo(const LookWish& wish) {
  return (wish.robot.map_from_base.Inverse() * wish.model.map_from_landmark).translation().norm();
}

Approach ApproachTo(const LookWish& wish, std::size_t edges_beyond) {
  const Pose2 at = wish.model.map_from_landmark.Inverse() * wish.robot.map_from_base;
  const double along = std::cos(at.yaw) < 0 ? at.x : -at.x;
  return {along < 0 ? along : at.translation().norm(), std::hypot(wish.robot.twist.vx, wish.robot.twist.vy),
          edges_beyond >= kEnoughBeyond};
}

}  // namespace priamos::head
