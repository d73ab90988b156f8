#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A part of an image [undistorted px].
struct FieldRegion {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
};

/// How near image edges of each direction run to each place of a region: 1 on an edge, falling as a Gaussian
/// beside it. A predicted edge is compared with the image by a few look-ups (directional chamfer
/// matching, Liu et al. 2010), so hundreds of poses can be compared in a millisecond.
class EdgeField {
 public:
  /// The lines of `view` in the region, each with a Gaussian of `sigma_px` on both sides.
  EdgeField(const CameraView& view, const FieldRegion& region, double sigma_px);

  /// Mean over the straight line from p to q [undistorted px], for edges of its direction, beyond the mean of
  /// the region, which is what any line gets by chance. Outside of the region nothing runs.
  double Along(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const;

 private:
  static constexpr int kDirections = 12;

  static int DirectionOf(const Eigen::Vector2d& d);
  void SetMeans(std::size_t plane);
  /// Whether a place [cells] is in the region, and not nearer to its border than `margin`.
  bool Holds(const Eigen::Vector2d& at, double margin) const {
    return at.x() >= margin && at.y() >= margin && at.x() < width_ - margin && at.y() < height_ - margin;
  }
  void Draw(const ViewLine& line, double sigma_cells);
  void Raise(int x, int y, int first_direction, int n_directions, float value);

  Eigen::Vector2d from_;
  double cell_px_;
  int width_, height_;
  std::vector<float> cells_;
  std::array<double, kDirections> mean_{};
};

}  // namespace priamos::head
