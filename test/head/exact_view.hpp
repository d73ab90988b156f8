#pragma once

#include <Eigen/Core>
#include <cmath>

#include "head/core/camera/projection.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::test {

/// Edges of space as a perfect operator would give them in one picture: for tests that want closed formulas
/// instead of pixels. Keep it as long as its views.
class ExactView {
 public:
  explicit ExactView(const head::CameraModel& camera, double sigma_px = 0.05)
      : camera_(camera), sigma_px_(sigma_px) {
    edges_.width = 768;
    edges_.height = 576;
  }
  ExactView(const ExactView&) = delete;
  ExactView& operator=(const ExactView&) = delete;

  /// A segment between two undistorted points of the picture, bright on the right hand, with points every
  /// `step_px` unless that is 0. Returns its number.
  int Draw(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, double dark = 80, double bright = 140,
           double step_px = 4) {
    head::EdgeSegment s;
    s.begin = camera_.Distort(begin);
    s.end = camera_.Distort(end);
    s.centre = (s.begin + s.end) / 2;
    s.sigma_normal_px = sigma_px_;
    s.sigma_angle_rad = sigma_px_ * std::sqrt(12.0) / (end - begin).norm();
    s.grey_left = dark;
    s.grey_right = bright;
    s.first_point = static_cast<int>(edges_.points.size());
    const double length = (end - begin).norm();
    for (double along = 0; step_px > 0 && along <= length; along += step_px)
      edges_.points.push_back({camera_.Distort(begin + along / length * (end - begin)), sigma_px_});
    s.n_points = static_cast<int>(edges_.points.size()) - s.first_point;
    edges_.segments.push_back(s);
    return static_cast<int>(edges_.segments.size()) - 1;
  }

  /// The image of an edge of space, which must lie in the picture.
  int See(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double dark = 80, double bright = 140) {
    return Draw(camera_.Project(from), camera_.Project(to), dark, bright);
  }

  head::CameraView View() const { return head::MakeView(camera_, edges_); }
  const head::CameraModel& camera() const { return camera_; }
  head::EdgeImage& edges() { return edges_; }

 private:
  head::CameraModel camera_;
  double sigma_px_;
  head::EdgeImage edges_;
};

}  // namespace priamos::test
