#pragma once

#include <vector>

#include "head/core/calibration/targets/camera_calibration.hpp"

namespace priamos::head {

/// Points of two photographs of one target that are all so near each other [px] come from one view of it: two
/// photographs from one stand differ by noise, of a few hundredths.
inline constexpr double kSameView_px = 0.5;

/// Whether two photographs by one camera show a flat target in the same pose. Such a pair says no more of the
/// lens than one of them. Which corner of the target counts as the first makes no difference.
bool ShowSameView(const std::vector<DiscObservation>& a, const std::vector<DiscObservation>& b);

}  // namespace priamos::head
