#pragma once

#include "common/config.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/landmark/landmark_fix.hpp"

namespace priamos::head {

/// How the head is turned for a look.
struct AimConfig {
  double side_share = 0.5;   ///< 0 looks at the middle of the landmark, 1 at the side asked for
  double margin_px = 30;     ///< an edge nearer to the border than this does not count as in the picture
  double sigmas = 2;         ///< and so many standard deviations of where it is expected
  double max_pan_deg = 100;  ///< farther the head does not turn
  double lead_s = 0.6;       ///< the robot drives on until the picture is taken

  void Describe(Archive& a);
};

/// The pan angle [rad] for a look at `side` (0 whole, 1 left, 2 right) of a landmark that is expected at
/// `prediction`. The upright edges of that side shall be in both pictures for certain, those of the other
/// side if that is possible as well; among such angles the one nearest to `side_share`. Straight ahead if the
/// landmark has no upright edges. `base` gives all axes but the pan.
double AimPan(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
              const LandmarkPrediction& prediction, int side, const AimConfig& config);

}  // namespace priamos::head
