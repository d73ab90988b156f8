#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace priamos::head {

/// One sub-pixel point of an edge: the mean of a few neighbouring rows (or columns). Undistorting the points
/// of a segment, not its ends, is what makes a lens with distortion harmless to long edges.
struct EdgePoint {
  Eigen::Vector2d at;          ///< [px]
  double sigma_normal_px = 0;  ///< standard deviation across the edge
};

/// A straight edge of the image (symbolic edge of the paper, section 4). Image frame: u right, v down, (0,0)
/// the centre of the top left pixel. It runs from `begin` to `end` with its bright side on the right hand, so
/// the direction carries the sign of the contrast.
struct EdgeSegment {
  Eigen::Vector2d begin = Eigen::Vector2d::Zero(), end = Eigen::Vector2d::Zero();  ///< [px]
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< point of the line where position and angle errors
                                                     ///< are uncorrelated [px]
  double sigma_normal_px = 0;                        ///< standard deviation across the line, at `centre`
  double sigma_angle_rad = 0;                        ///< standard deviation of the direction
  double grey_left = 0, grey_right = 0;  ///< grey values 3 to 4 px beside the line; left is darker
  int first_point = 0, n_points = 0;     ///< its points in EdgeImage::points

  Eigen::Vector2d direction() const { return (end - begin).normalized(); }
  /// Unit normal towards the bright side.
  Eigen::Vector2d normal() const {
    const Eigen::Vector2d d = direction();
    return {-d.y(), d.x()};
  }
  double length_px() const { return (end - begin).norm(); }
  double contrast() const { return grey_right - grey_left; }
  /// Standard deviation across the line at a point `along` px from `centre`.
  double SigmaAt(double along) const { return std::hypot(sigma_normal_px, along * sigma_angle_rad); }
};

/// Everything the edge operator found in one image.
struct EdgeImage {
  int width = 0, height = 0;
  double noise_sigma = 0;  ///< estimated noise of a pixel [grey values]
  double mean_grey = 0;
  double saturated_share = 0;  ///< share of pixels at 0 or 255
  std::vector<EdgeSegment> segments;
  std::vector<EdgePoint> points;
};

}  // namespace priamos::head
