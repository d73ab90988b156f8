#pragma once

#include <array>
#include <vector>

#include "head/core/doors/door_evidence.hpp"
#include "head/core/doors/door_outlines.hpp"

namespace priamos::head {

/// A level line in the plane of an outline, below the camera: the floor, skirting, or the lower border of
/// what hangs there.
struct WallLine {
  double drop = 0;    ///< below the camera, per metre of the lintel's height above the camera
  double beside = 0;  ///< length beside the outline, in widths of it
  double within = 0;  ///< length between the uprights, in widths of it
};

/// Evidence of an outline that does not depend on its scale.
struct OutlineEvidence {
  DoorEvidence edges;  ///< lintel and nested frame; what depends on the floor is not used
  std::vector<WallLine> wall_lines;
  int box_corners =
      0;               ///< corners from which a level line leads away from the wall, as the top of a box does
  double wall_px = 0;  ///< length of level lines that run along its wall, its own excepted
};

/// Weighs the outlines of one level view (origin at its camera, z up), which is kept.
class OutlineWeigher {
 public:
  explicit OutlineWeigher(const CameraView& level_view);
  OutlineWeigher(const OutlineWeigher&) = delete;
  OutlineWeigher& operator=(const OutlineWeigher&) = delete;

  OutlineEvidence Weigh(const DoorOutline& outline) const;

 private:
  const CameraView& view_;
  CameraModel usual_camera_;  ///< at a usual height
  CameraView usual_view_;
  Eigen::Matrix3d rays_;
};

/// Log odds of a door against whatever else has two uprights and a level edge over them, for a camera at
/// `camera_m` above the floor and a lintel at `height_m`.
double OutlineLogOdds(const DoorOutline& outline, const OutlineEvidence& evidence, double camera_m,
                      double height_m);

}  // namespace priamos::head
