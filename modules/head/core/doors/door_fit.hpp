#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "head/core/doors/door_evidence.hpp"

namespace priamos::head {

/// Which image lines are a door's: indices in CameraView::lines, -1 where a camera does not see an edge.
/// First index: camera.
struct DoorLines {
  std::array<std::array<int, 2>, 2> uprights{{{-1, -1}, {-1, -1}}};  ///< left, right
  std::array<int, 2> lintel{-1, -1};
};

/// The door that explains all lines best, base frame.
struct DoorFit {
  DoorShape shape;
  /// Covariance of (left x, left y, right x, right y, height), base frame [m^2].
  Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Zero();
  double chi2 = 0;
  int freedom = 0;  ///< observations beyond the five unknowns
};

/// Two uprights and a level lintel between them that explain all lines best, in both images at once: least
/// squares from `start`. `sigma_px` is the deviation of real doors from that, beyond the noise of the edges.
/// nullopt if the lines do not determine them, or lead far away from the start.
std::optional<DoorFit> FitDoor(const std::array<const CameraView*, 2>& views, const DoorLines& lines,
                               const DoorShape& start, double sigma_px);

}  // namespace priamos::head
