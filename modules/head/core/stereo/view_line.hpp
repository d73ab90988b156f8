#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/projection.hpp"
#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// An edge segment without lens distortion, with its plane of sight: the plane through it and the optical
/// centre.
struct ViewLine {
  int segment = 0;         ///< index in EdgeImage::segments, whose points are at the same place in CameraView
  Eigen::Vector2d p, q;    ///< begin and end [undistorted px]
  Eigen::Vector2d normal;  ///< unit, towards the bright side
  double length_px = 0;
  Eigen::Vector4d plane;  ///< plane.dot(point in base, homogeneous) = 0; the first three have unit length
  double contrast = 0;
};

/// The ends and lengths of all lines as arrays of numbers, for a fast search.
struct LineTable {
  std::vector<float> px, py, qx, qy, length;
};

/// The edges of one image with their camera model, distorted and undistorted.
struct CameraView {
  const CameraModel* camera = nullptr;
  const EdgeImage* edges = nullptr;
  ImageSize size;
  std::vector<ViewLine> lines;
  std::vector<Eigen::Vector2d> points;  ///< EdgeImage::points, undistorted
  LineTable table = {};
  double blur_px = 0;  ///< of the image beyond that of its pixels, standard deviation: 0 when it is sharp
  const cv::Mat* image = nullptr;  ///< the image itself (CV_8UC1, distorted), where it is at hand
};

/// Both images of one exposure: left, right.
using StereoViews = std::array<CameraView, 2>;

/// Undistorts the points of all segments and fits the lines to them, so that long edges that the lens bends
/// are straight. Keeps references to both arguments.
CameraView MakeView(const CameraModel& camera, const EdgeImage& edges);

/// Height above the floor at which the line passes the vertical at `at` (x, y) of the base frame [m]; large
/// or infinite for a line that is upright itself.
double HeightOn(const ViewLine& line, const Eigen::Vector2d& at);

}  // namespace priamos::head
