#pragma once

#include <array>

#include "common/archive.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/landmark/pose_history.hpp"

namespace priamos::head {

/// Settings of the pan angle for a look.
struct AimConfig {
  double side_share = 0.5;   ///< 0: aim at the middle of the landmark, 1: at the side ordered
  double margin_px = 30;     ///< an edge nearer to the border than this does not count as in the picture
  double sigmas = 2;         ///< added to that margin, in standard deviations of the predicted edge
  double max_pan_deg = 100;  ///< largest pan angle
  double near_m = 1.3;  ///< nearer, one picture of a side is enough, and turning costs more than it tells
  double lead_s = 0.6;  ///< time until the picture is taken, in which the robot drives on

  void Describe(Archive& a);
};

/// The pan angle [rad] for a look at `side` (0 whole, 1 left, 2 right) of a landmark that is expected at
/// `prediction`. The upright edges of that side shall be in both pictures for certain, those of the other
/// side if that is possible as well; among such angles the one nearest to `side_share`. Nearer than `near_m`
/// one of the pictures shall show that side, also when the landmark is `afterwards`: so the looks that follow
/// need not turn the head, and what lies between the sides stays in the pictures. Straight ahead if the
/// landmark has no upright edges. `base` gives all axes but the pan.
double AimPan(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
              const LandmarkPrediction& prediction, const LandmarkPrediction& afterwards, int side,
              const AimConfig& config);
/// The same of a landmark that stays where it is.
inline double AimPan(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
                     const LandmarkPrediction& prediction, int side, const AimConfig& config) {
  return AimPan(head, base, model, prediction, prediction, side, config);
}

/// How far [px] the upright edges of one side are outside of the usable part of a picture at `setting`, the
/// farthest of them in the better picture; 0: one shows them all for certain.
double SideOutsideBy(const HeadModel& head, const HeadSetting& setting, const LandmarkModel& model,
                     const LandmarkPrediction& prediction, int side, const AimConfig& config);

/// How far [px] one edge of the model may be outside of the usable part of a picture, of the worse one of
/// both: margin and standard deviations are added to its place. 0: it is in both for certain. An upright edge
/// counts by its bearing at the height at which cameras tilted by `tilt_rad` look at it, a level one by its
/// height in the picture; other edges, and movable ones, are nowhere.
double OutsideBy(const HeadGeometry& head, const std::array<CameraModel, 2>& cameras, double tilt_rad,
                 const LandmarkEdge& edge, const LandmarkPrediction& prediction, const AimConfig& config);

}  // namespace priamos::head
