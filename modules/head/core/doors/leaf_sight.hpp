#pragma once

#include <vector>

#include "common/ground_plan.hpp"
#include "head/core/stereo/vertical_stereo.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// What one look shows of a door's leaf.
struct LeafSight {
  /// On which side it hangs, as the approaching robot sees the door.
  enum class Hinge { kNotSeen = 0, kLeft = 1, kRight = 2 };
  Hinge hinge = Hinge::kNotSeen;
  double open_rad = 0;   ///< 0 is closed; it opens into the far room
  double sigma_rad = 0;  ///< sigma of that angle
  double log_odds =
      0;  ///< of this leaf against clutter behind the door; for kNotSeen of the best one refused
};

/// What is known beforehand of a leaf, and what evidence one needs to be seen.
struct LeafOptions {
  double thickness_m = 0.04;
  double least_rad = Radians(8), most_rad = Radians(118);  ///< angles beyond show nothing of the leaf
  double pin_sigma_m = 0.012;        ///< how well hinges and breadth of the leaf are known, each axis
  double gate = 3;                   ///< of the free edge from its circle about the hinges, in sigmas
  double min_log_odds = 1;           ///< least log odds of a leaf that is seen
  double min_lead = 2;               ///< log odds wanted over the best leaf at another angle
  double distinct_rad = Radians(4);  ///< angles farther apart are different
  VerticalStereoOptions stereo;
};

/// The leaf of a door whose pose is known, from one stereo pair. Every upright edge that both cameras see
/// through the opening, and that lies where the free edge of a leaf may be (on a circle about the hinges), is
/// a hypothesis. Both images are asked for the free edge up to the leaf's top and no farther, and for the
/// upper edge from there to the hinges; what is seen in space where the leaf would hide it speaks against.
LeafSight SeeLeaf(const DoorPlan& door, const Pose2& base_from_door, const StereoViews& views,
                  const LeafOptions& options = {});

}  // namespace priamos::head
