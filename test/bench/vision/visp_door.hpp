#pragma once

#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

struct VispFix {
  bool ok = false;
  Pose2 base_from_landmark;
  double seconds = 0;
};

/// What ViSP's edge tracker makes of one look: the model without errors, the calibrated cameras.
VispFix FixWithVisp(const LandmarkLook& look, bool both_cameras);

}  // namespace priamos::bench
