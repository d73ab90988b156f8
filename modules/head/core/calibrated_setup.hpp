#pragma once

#include <array>
#include <optional>
#include <span>

#include "head/core/camera_model.hpp"
#include "head/core/head_setting.hpp"

namespace priamos::head {

/// One head setting with the cameras as calibrated there, in the base frame.
struct CalibratedSetup {
  HeadSetting setting;
  std::array<CameraModel, 2> cameras;  ///< left, right
};

/// The setup nearest to a pan angle and level within `tolerance_rad`; nullptr if none is that near.
inline const CalibratedSetup* FindSetup(std::span<const CalibratedSetup> setups, double pan_rad,
                                        double tolerance_rad) {
  const CalibratedSetup* best = nullptr;
  for (const CalibratedSetup& setup : setups) {
    const double distance = std::abs(setup.setting.pan_rad - pan_rad);
    if (distance > tolerance_rad || (best && distance >= std::abs(best->setting.pan_rad - pan_rad))) continue;
    best = &setup;
  }
  return best;
}

}  // namespace priamos::head
