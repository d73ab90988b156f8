#pragma once

#include "common/archive.hpp"

namespace priamos::world {

/// How wrong the map is: whoever measured the building had a tape and a few hours. Drawn from the seed for
/// each door, and told to nobody.
struct SurveyPlan {
  double place_m = 0;       ///< a door and its wall are off by up to this, along each axis
  double yaw_deg = 0;       ///< they are turned by up to this
  double size_sigma_m = 0;  ///< sigma of every dimension of a door, cut off at three of them
  double narrower_m = 0;    ///< its opening is narrower by up to this, in addition

  void Describe(Archive& a);
};

}  // namespace priamos::world
