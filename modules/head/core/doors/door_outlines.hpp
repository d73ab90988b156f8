#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// Two uprights and a level line over them in one image, at no scale: what they are that stands there, and
/// how far away, is not known. Frame: origin at the camera's centre, z up.
struct DoorOutline {
  int lintel = 0;                           ///< index in CameraView::lines
  double lintel_share = 0;                  ///< of its length that this line covers
  std::array<int, 2> uprights{};            ///< the same: left, right as the camera sees them
  std::array<Eigen::Vector2d, 2> bearings;  ///< unit directions of the uprights, seen from above
  std::array<double, 2> rises{};            ///< tangents of the elevation of their upper ends, positive
  std::array<Eigen::Vector2d, 2> corners;   ///< these ends [undistorted px]
  /// Tangents of how far below the horizon the uprights are covered; not positive: they end above it.
  std::array<double, 2> falls{};
  std::array<bool, 2> foot_inside{};  ///< the cover ends within the picture
  std::array<double, 2> covered{};    ///< share of the uprights from the corners down to these ends
  std::array<double, 2> first_px{};   ///< where their cover begins, from the corner

  /// Plan of an upright per metre of the lintel's height above the camera.
  Eigen::Vector2d At(int side) const { return bearings[side] / rises[side]; }
  double width() const { return (At(0) - At(1)).norm(); }
};

/// What is asked of an outline, beside the shape of doors.
struct OutlineOptions {
  double max_lean_rad = 0.02;             ///< of an upright, beyond the noise of its edge
  double min_upright_px = 14;             ///< shortest edge of an upright
  double min_span_share = 0.3;            ///< of the lintel's length that its edge covers
  double min_width_px = 14;               ///< of the outline in the image
  double min_width = 0.5, max_width = 6;  ///< per metre of the lintel's height above the camera
};

/// All outlines of a level view (origin at its camera, z up).
std::vector<DoorOutline> FindOutlines(const CameraView& level_view, const OutlineOptions& options);

}  // namespace priamos::head
