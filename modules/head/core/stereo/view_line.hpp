#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/projection.hpp"
#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// A segment freed from lens distortion, with the plane of space that the optical centre spans with it.
struct ViewLine {
  int segment = 0;         ///< index in EdgeImage::segments, whose points are at the same place in CameraView
  Eigen::Vector2d p, q;    ///< begin and end [undistorted px]
  Eigen::Vector2d normal;  ///< unit, towards the bright side
  double length_px = 0;
  Eigen::Vector4d plane;  ///< plane.dot(point in base, homogeneous) = 0; the first three have unit length
  double contrast = 0;
};

/// The ends of all lines once more, one number after the other, for fast search.
struct LineTable {
  std::vector<float> px, py, qx, qy, length;
};

/// What one camera saw: its edges, and how to undo its lens.
struct CameraView {
  const CameraModel* camera = nullptr;
  const EdgeImage* edges = nullptr;
  ImageSize size;
  std::vector<ViewLine> lines;
  std::vector<Eigen::Vector2d> points;  ///< EdgeImage::points, undistorted
  LineTable table = {};
};

/// Both images of one exposure: left, right.
using StereoViews = std::array<CameraView, 2>;

/// Undistorts the points of all segments and lays the lines through them: a long edge that the lens bends is
/// straight again. Keeps references to both arguments.
CameraView MakeView(const CameraModel& camera, const EdgeImage& edges);

}  // namespace priamos::head
