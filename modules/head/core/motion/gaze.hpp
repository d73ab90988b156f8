#pragma once

#include <optional>
#include <vector>

#include "head/core/camera/head_model.hpp"
#include "head/core/motion/aim.hpp"
#include "head/core/motion/aim_far.hpp"
#include "head/core/motion/aim_tilt.hpp"
#include "head/core/motion/follow_up.hpp"
#include "head/core/motion/lens_choice.hpp"

namespace priamos::head {

/// How settings of the head for looks are chosen.
struct GazeConfig {
  HeadSetting fixed;  ///< of all looks; each look sets the pan itself, and what else the rest chooses
  AimConfig aim;
  TiltConfig look_up;
  LensChoiceConfig lens;
  int approach_steps = 0;  ///< of the motors of zoom and focus
};

/// How the head stands when a look begins.
struct HeadStanding {
  std::optional<HeadSetting> here;  ///< where its motors are, if they have reported
  std::optional<HeadSetting> kept;  ///< where it stands for the same side of the same landmark
};

/// The setting for a look at a side of a landmark. A head that stands well enough for it stays.
HeadSetting SettingFor(const HeadModel& head, const LookWish& wish, const HeadStanding& standing,
                       const GazeConfig& config);

/// The setting for a look at what stands beyond a landmark, places in the landmark's frame: to the side on
/// which most of it will be in both pictures.
HeadSetting SettingBeyond(const HeadModel& head, const LookWish& wish, std::vector<UprightTarget> beyond,
                          const GazeConfig& config);

/// Distance of the landmark from the base [m].
double DistanceTo(const LookWish& wish);

/// Where the base is before the landmark, with so many edges known beyond it.
Approach ApproachTo(const LookWish& wish, std::size_t edges_beyond);

}  // namespace priamos::head
