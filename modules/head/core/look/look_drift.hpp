#pragma once

#include <optional>
#include <span>

#include "head/core/drift/stereo_drift.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// Turn of the right camera against the left one [rad], from one look: all edges that both images show
/// (`matches`) measure it across the epipolar lines, and the edges of a landmark that was found (or fits
/// badly) about the other axes as well. nullopt if an image is blind or the edges do not determine the turn.
std::optional<StereoDrift> MeasureLookDrift(const LandmarkModel& model, const LandmarkFix& fix,
                                            const StereoViews& views, std::span<const StereoMatch> matches,
                                            const StereoDriftOptions& options);

}  // namespace priamos::head
