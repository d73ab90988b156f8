#pragma once

#include "common/archive.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// How far the head looks up, so that what lies above an opening is in the pictures.
struct TiltConfig {
  double most_deg = 30;   ///< no farther than this
  double margin_px = 30;  ///< an edge nearer to the upper border does not count as in the picture

  void Describe(Archive& a);
};

/// The tilt [rad], positive down, for a look at a landmark at `base_from_landmark`: that of `base`, or as
/// much farther up as both pictures need to show the highest of its level edges that a viewer there sees.
/// From near, that is what else than one jamb there is to be seen of a door, and what tells the heading best.
/// That of `base` where `most_deg` is not enough, or the landmark has no such edge. `base` gives all other
/// axes.
double AimTilt(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
               const Pose2& base_from_landmark, const TiltConfig& config);

}  // namespace priamos::head
