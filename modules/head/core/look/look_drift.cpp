#include "head/core/look/look_drift.hpp"

#include <algorithm>
#include <iterator>

#include "head/core/drift/epipolar_shift.hpp"
#include "head/core/landmark/edge_observations.hpp"

namespace priamos::head {
namespace {

/// From the edges of the landmark, at the pose where it was found.
std::optional<StereoDrift> DriftOfLandmark(const LandmarkModel& model, const LandmarkFix& fix,
                                           const StereoViews& views, const StereoDriftOptions& options) {
  if (fix.verdict != Verdict::kFound && fix.verdict != Verdict::kResidualTooLarge) return std::nullopt;
  const Eigen::Isometry3d base_from_landmark = Lift(fix.base_from_landmark);
  Association association;
  std::ranges::copy_if(fix.matches, std::back_inserter(association.matches),
                       [](const EdgeMatch& match) { return match.camera < 2; });
  const auto observations = Observations(model, association, views, base_from_landmark, false);
  return MeasureDrift(model, observations, *views[0].camera, *views[1].camera, base_from_landmark, options);
}

}  // namespace

std::optional<StereoDrift> MeasureLookDrift(const LandmarkModel& model, const LandmarkFix& fix,
                                            const StereoViews& views, std::span<const StereoMatch> matches,
                                            const StereoDriftOptions& options) {
  if (IsBlind(*views[0].edges) || IsBlind(*views[1].edges)) return std::nullopt;
  auto drift = DriftOfLandmark(model, fix, views, options);
  const auto shift = MeasureEpipolarShift(views[0], views[1], matches);
  if (!shift) return drift;
  return Fuse(drift.value_or(UnknownDrift()), *shift, *views[1].camera);
}

}  // namespace priamos::head
