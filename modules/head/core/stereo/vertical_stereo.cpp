#include "head/core/stereo/vertical_stereo.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace priamos::head {
namespace {

/// An upright plane of sight as a line on the floor: a * x + b * y + c = 0, (a, b) of unit length.
struct FloorLine {
  int line = 0;
  Eigen::Vector3d coefficients;
  double sigma_rad = 0;  ///< sigma of its direction
  double contrast = 0;   ///< signed: positive if it is brighter where the coefficients give positive values
};

/// The image's horizon is where cameras look from; planes are cut at that height.
std::vector<FloorLine> UprightPlanes(const CameraView& view, const VerticalStereoOptions& options) {
  const Eigen::Vector3d centre = OpticalCentre(*view.camera);
  std::vector<FloorLine> upright;
  for (std::size_t i = 0; i < view.lines.size(); ++i) {
    const ViewLine& line = view.lines[i];
    const EdgeSegment& segment = view.edges->segments[line.segment];
    const double lean = std::abs(line.plane.z()), noise = segment.sigma_angle_rad;
    if (lean > options.max_lean_rad + 3 * noise) continue;
    const double scale = 1 / line.plane.head<2>().norm();
    FloorLine floor;
    floor.line = static_cast<int>(i);
    floor.coefficients << line.plane.x() * scale, line.plane.y() * scale, 0;
    floor.coefficients.z() = -floor.coefficients.head<2>().dot(centre.head<2>());
    // One pixel across the line turns the plane by 1/focal length, measured in the direction of sight.
    const Eigen::Matrix<double, 3, 3> m = view.camera->image_from_base.leftCols<3>();
    const Eigen::Vector2d middle = (line.p + line.q) / 2;
    const Eigen::Vector3d ray = (m.inverse() * middle.homogeneous()).normalized();
    const double depth = m.row(2).dot(ray);
    const Eigen::RowVector3d across = line.normal.transpose() * (m.topRows<2>() - middle * m.row(2)) / depth;
    floor.sigma_rad = std::hypot(segment.sigma_normal_px, options.camera_sigma_px) / across.norm();
    floor.contrast = line.contrast;
    if (across.dot(Eigen::RowVector3d(floor.coefficients.x(), floor.coefficients.y(), 0)) < 0) {
      floor.coefficients = -floor.coefficients;
    }
    upright.push_back(floor);
  }
  return upright;
}

/// Height at which the image point is seen on the vertical through `at`.
double HeightAt(const CameraModel& camera, const Eigen::Vector2d& at, double v) {
  const Eigen::RowVector4d row = camera.image_from_base.row(1) - v * camera.image_from_base.row(2);
  return -(row.x() * at.x() + row.y() * at.y() + row.w()) / row.z();
}

struct Heights {
  double low, high;
};

Heights HeightsOf(const CameraView& view, int line, const Eigen::Vector2d& at) {
  const double a = HeightAt(*view.camera, at, view.lines[line].p.y());
  const double b = HeightAt(*view.camera, at, view.lines[line].q.y());
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

std::vector<VerticalEdge> MatchVerticals(const CameraView& left, const CameraView& right,
                                         const VerticalStereoOptions& options) {
  const std::vector<FloorLine> in_left = UprightPlanes(left, options),
                               in_right = UprightPlanes(right, options);
  std::vector<VerticalEdge> edges;
  for (const FloorLine& l : in_left) {
    for (const FloorLine& r : in_right) {
      const double ratio = l.contrast / r.contrast;
      if (ratio > options.max_contrast_ratio || ratio * options.max_contrast_ratio < 1) continue;
      if (l.coefficients.head<2>().dot(r.coefficients.head<2>()) < 0.7) continue;  // other sign of contrast
      const Eigen::Vector3d cross = l.coefficients.cross(r.coefficients);
      if (std::abs(cross.z()) < 0.01) continue;
      VerticalEdge edge;
      edge.at = cross.head<2>() / cross.z();
      const double range = edge.at.norm();
      if (edge.at.x() <= 0 || range < options.min_range_m || range > options.max_range_m) continue;
      const Heights a = HeightsOf(left, l.line, edge.at), b = HeightsOf(right, r.line, edge.at);
      edge.z_min_m = std::max(a.low, b.low);
      edge.z_max_m = std::min(a.high, b.high);
      if (edge.z_max_m - edge.z_min_m < options.min_overlap * std::min(a.high - a.low, b.high - b.low))
        continue;
      edge.left = l.line;
      edge.right = r.line;
      Eigen::Matrix2d normals;
      normals << l.coefficients.head<2>().transpose(), r.coefficients.head<2>().transpose();
      const Eigen::Matrix2d spread =
          normals.inverse() * Eigen::Vector2d(l.sigma_rad, r.sigma_rad).asDiagonal() * range;
      edge.covariance = spread * spread.transpose();
      edges.push_back(edge);
    }
  }
  return edges;
}

}  // namespace priamos::head
