#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/reference_object.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// The points centre + shape^(1/2) * (cos t, sin t): an ellipse in the image, in pixels.
struct Ellipse {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d shape_px2 = Eigen::Matrix2d::Identity();  ///< symmetric, positive definite

  double SemiMajor() const;
  double SemiMinor() const;
  double Area() const;
};

/// The image of a disc under a projection matrix, without lens distortion; nullopt if the disc is not
/// wholly before the camera or seen edge-on. Exact: the dual conic of the disc's rim is projected.
std::optional<Ellipse> ProjectDisc(const Eigen::Matrix<double, 3, 4>& image_from_base,
                                   const ReferenceDisc& disc);

/// Where the centroid of the disc's image lies [distorted px]. It is not the image of the disc's centre:
/// perspective shifts the ellipse's centre, and the lens bends the ellipse. The paper overlooks both.
/// nullopt as for ProjectDisc.
std::optional<Eigen::Vector2d> ProjectDiscCentroid(const CameraModel& camera, const ReferenceDisc& disc);

/// ProjectDiscCentroid minus the distorted image of the disc's centre: what has to be subtracted from a
/// measured centroid [px]. Zero where the disc is not visible.
Eigen::Vector2d CentroidBias(const CameraModel& camera, const ReferenceDisc& disc);

}  // namespace priamos::head
