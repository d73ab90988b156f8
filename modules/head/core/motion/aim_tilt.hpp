#pragma once

#include "common/archive.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// How far the head looks up, so that what lies above an opening is in the pictures.
struct TiltConfig {
  double most_deg = 45;   ///< no farther than this
  double margin_px = 30;  ///< an edge nearer to the upper border does not count as in the picture
  double ahead_s = 1.5;   ///< looks that follow by then need no other tilt, as far as this one allows

  void Describe(Archive& a);
};

/// The tilt [rad], positive down, for a look at a landmark at `base_from_landmark`: that of `base`, or as
/// much farther up as both pictures need to show the highest of its level edges that a viewer there sees.
/// From near, that is what else than one jamb there is to be seen of a door, and what tells the heading best.
/// It looks up farther still where the highest edge stays in the upper half of both pictures and a look from
/// where the landmark is `afterwards` needs that: turning takes longer than looking. An edge for which
/// `most_deg` is not enough does not count; that of `base` where none does. `base` gives all other axes.
double AimTilt(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
               const Pose2& base_from_landmark, const Pose2& afterwards, const TiltConfig& config);

/// The same of a landmark that stays where it is.
inline double AimTilt(const HeadModel& head, const HeadSetting& base, const LandmarkModel& model,
                      const Pose2& base_from_landmark, const TiltConfig& config) {
  return AimTilt(head, base, model, base_from_landmark, base_from_landmark, config);
}

/// How many level edges of the landmark both pictures show at `setting`.
int LevelEdgesShown(const HeadModel& head, const HeadSetting& setting, const LandmarkModel& model,
                    const Pose2& base_from_landmark, const TiltConfig& config);

}  // namespace priamos::head
