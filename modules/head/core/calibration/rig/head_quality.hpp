#pragma once

#include <vector>

#include "head/core/calibration/rig/head_solver.hpp"
#include "head/core/calibration/targets/calibration_quality.hpp"

namespace priamos::head {

/// The experiment of section 3.1.5 of the paper with the whole head: every exposure's discs reconstructed by
/// the cameras that the table gives for its setting, errors of the motors included.
ReconstructionErrors ReconstructObject(const std::vector<HeadView>& views, const HeadModel& head);

/// F (equation 7) of exposures that took no part.
struct HeldOutErrors {
  int exposures = 0;
  double mean_px = 0;
};

/// Solves without one exposure of every zoom and focus that was seen more than once, and predicts that. Takes
/// as long as SolveHead. Refuses what SolveHead refuses, and views of which none can be spared.
Outcome<HeldOutErrors> PredictHeldOut(const std::vector<HeadView>& views, const HeadKnowledge& known = {});

}  // namespace priamos::head
