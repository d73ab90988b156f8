#include "head/core/stereo/view_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace priamos::head {
namespace {

/// CameraModel::Undistort for thousands of points: the radial factor from a table, where there is one.
class FastUndistort {
 public:
  FastUndistort(const CameraModel& camera, const ImageSize& size)
      : camera_(camera), is_radial_(camera.IsRadial()) {
    if (!is_radial_) return;
    const double reach = std::hypot(std::max(camera.centre_px.x(), size.width - camera.centre_px.x()),
                                    std::max(camera.centre_px.y(), size.height - camera.centre_px.y()));
    per_squared_px_ = (kSize - 1) / (reach * reach);
    for (int i = 0; i <= kSize; ++i) {
      const double r = std::sqrt(i / per_squared_px_);
      const Eigen::Vector2d at = camera.centre_px + Eigen::Vector2d(r, 0);
      factor_[i] = i == 0 ? 1 : (camera.Undistort(at) - camera.centre_px).x() / r;
    }
  }
  Eigen::Vector2d operator()(const Eigen::Vector2d& distorted_px) const {
    if (!is_radial_) return camera_.Undistort(distorted_px);
    const Eigen::Vector2d d = distorted_px - camera_.centre_px;
    const double at = std::min(d.squaredNorm() * per_squared_px_, kSize - 1e-9);
    const int i = static_cast<int>(at);
    return camera_.centre_px + d * (factor_[i] + (at - i) * (factor_[i + 1] - factor_[i]));
  }

 private:
  static constexpr int kSize = 128;
  const CameraModel& camera_;
  bool is_radial_;
  double per_squared_px_ = 0;
  std::array<double, kSize + 1> factor_{};
};

/// Moves p and q onto the least squares line through `points`.
void FitTo(std::span<const Eigen::Vector2d> points, Eigen::Vector2d& p, Eigen::Vector2d& q) {
  if (points.size() < 3) return;
  const Eigen::Vector2d direction = (q - p).normalized(), normal(-direction.y(), direction.x());
  double n = 0, st = 0, ss = 0, stt = 0, sts = 0;
  for (const Eigen::Vector2d& point : points) {
    const double t = direction.dot(point - p), s = normal.dot(point - p);
    n += 1;
    st += t;
    ss += s;
    stt += t * t;
    sts += t * s;
  }
  const double det = n * stt - st * st;
  if (det <= 0) return;
  const double slope = (n * sts - st * ss) / det, offset = (ss - slope * st) / n;
  const double length = direction.dot(q - p);
  q = p + length * direction + (offset + slope * length) * normal;
  p += offset * normal;
}

}  // namespace

CameraView MakeView(const CameraModel& camera, const EdgeImage& edges) {
  CameraView view{&camera, &edges, {edges.width, edges.height}, {}, {}};
  const FastUndistort undistort(camera, view.size);
  view.points.reserve(edges.points.size());
  for (const EdgePoint& point : edges.points) view.points.push_back(undistort(point.at));
  view.lines.reserve(edges.segments.size());
  for (std::size_t i = 0; i < edges.segments.size(); ++i) {
    const EdgeSegment& segment = edges.segments[i];
    ViewLine line;
    line.segment = static_cast<int>(i);
    line.p = undistort(segment.begin);
    line.q = undistort(segment.end);
    FitTo(std::span(view.points).subspan(segment.first_point, segment.n_points), line.p, line.q);
    const Eigen::Vector2d direction = line.q - line.p;
    line.length_px = direction.norm();
    line.normal = Eigen::Vector2d(-direction.y(), direction.x()) / line.length_px;
    line.contrast = segment.contrast();
    line.plane = camera.image_from_base.transpose() *
                 Eigen::Vector3d(line.normal.x(), line.normal.y(), -line.normal.dot(line.p));
    line.plane /= line.plane.head<3>().norm();
    view.lines.push_back(line);
  }
  for (const ViewLine& line : view.lines) {
    view.table.px.push_back(static_cast<float>(line.p.x()));
    view.table.py.push_back(static_cast<float>(line.p.y()));
    view.table.qx.push_back(static_cast<float>(line.q.x()));
    view.table.qy.push_back(static_cast<float>(line.q.y()));
    view.table.length.push_back(static_cast<float>(line.length_px));
  }
  return view;
}

double HeightOn(const ViewLine& line, const Eigen::Vector2d& at) {
  return -(line.plane.head<2>().dot(at) + line.plane.w()) / line.plane.z();
}

}  // namespace priamos::head
