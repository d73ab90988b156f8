#pragma once

#include "head/core/motion/aim.hpp"
#include "head/core/motion/aim_tilt.hpp"

namespace priamos::head {

/// Two settings for a look at one side of a landmark: where the head stands, and where it would best stand.
struct TwoSettings {
  HeadSetting here, best;
};

/// Whether a look from where the head stands shows about as much as from the best setting: as many level
/// edges, and the side's upright edges in one picture. Turning takes most of a look's time, in which the base
/// drives on. Also where the best setting is not tilted up, but this one is: what there is to be seen higher
/// up would be out of sight before the head has turned. `expected`: where the landmark is now.
bool MayStay(const HeadModel& head, const TwoSettings& settings, const LandmarkModel& model,
             const LandmarkPrediction& expected, int side, const AimConfig& aim, const TiltConfig& look_up);

}  // namespace priamos::head
