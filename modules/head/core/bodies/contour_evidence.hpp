#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "head/core/bodies/body_agreement.hpp"
#include "head/core/edges/step_meter.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// How much of a body's visible contour the grey values of the images show where a pose predicts it, piece by
/// piece, also where no edge was linked. Shares of its length, all images together, long edges counted less.
struct ContourEvidence {
  double seen = 0;              ///< a step of brightness is there, within a pixel or so
  double blank = 0;             ///< nothing is there at all: the faces beside it may be alike
  double other = 0;             ///< something else is there
  double rms_px = 0;            ///< root mean square of the distances of what is seen
  int n_seen = 0, n_edges = 0;  ///< edges of which nearly half is seen; all that should be seen

  /// How much of the contour is seen, to compare poses of one body.
  double Shown() const;
  /// What tells right poses from wrong ones: `agreement` is BodyAgreement::Value of the same pose. The
  /// weights come from poses of made-up bodies, blurred, right and wrong (FIGURES.md).
  double Value(double agreement) const { return agreement + Shown(); }
  /// Log odds, less what is asked of a fix, of a pose that FitContour found in a blurred image, with what the
  /// linked edges there show. `prior_sigmas`: how far from the belief it is. The weights come from such
  /// poses.
  double LogOdds(const BodyAgreement& linked, double prior_sigmas) const;
};

/// The evidence for a body whose visible edges `seen` stand at `base_from_model`. `meters`: one for each
/// view.
ContourEvidence EvidenceOf(const LandmarkModel& seen, const Eigen::Isometry3d& base_from_model,
                           std::span<const CameraView> views, std::span<const StepMeter> meters);

}  // namespace priamos::head
