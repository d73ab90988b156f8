#pragma once

#include <optional>
#include <span>

#include "head/core/drift/stereo_drift.hpp"
#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// How far the ends of matched edges lie below the epipolar lines of their partners, in the right image.
struct EpipolarShift {
  double down_px = 0;                            ///< shift, positive downwards [undistorted px]
  double sigma_px = 0;                           ///< standard deviation of the shift
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< middle of the ends that count [undistorted px]
  int n = 0;                                     ///< number of ends that count
};

/// Which ends of matched edges count; distances from epipolar lines [undistorted px].
struct EpipolarShiftOptions {
  double min_epipolar_rad = 0.7;  ///< flatter edges have ends that slide along the epipolar lines
  double reach_px = 6;            ///< ends farther from their epipolar line are left out
  double core_px = 1.2;           ///< residuals farther from the mode have no weight
  int min_ends = 12;              ///< least number of ends near the mode
  double min_share = 0.35;        ///< least share of the ends within reach that are near the mode
  double floor_px = 0.12;         ///< systematic part of sigma_px, however many ends there are
};

/// Mean epipolar residual of the ends of all matched edges, known landmark or not. More than half of the ends
/// are not physical (broken, hidden, cut by the image), so the estimate is robust: the mode of the residuals,
/// refined with Tukey's biweight around it. nullopt if too few ends are near the mode.
std::optional<EpipolarShift> MeasureEpipolarShift(const CameraView& left, const CameraView& right,
                                                  std::span<const StereoMatch> matches,
                                                  const EpipolarShiftOptions& options = {});

/// Kalman update of the right camera's turn, which the landmark gave, with a shift.
StereoDrift Fuse(const StereoDrift& drift, const EpipolarShift& shift, const CameraModel& right);

/// Prior of the drift for looks at which no landmark was found: no turn, wide about x and y, and a roll of
/// fractions of a degree, as of a camera that came loose.
StereoDrift UnknownDrift();

}  // namespace priamos::head
