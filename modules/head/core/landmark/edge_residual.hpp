#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "head/core/camera/camera_model.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// A point of the image that lies on an edge of the model.
struct EdgeObservation {
  int edge = 0, camera = 0;
  Eigen::Vector2d at;   ///< undistorted [px]
  double sigma_px = 0;  ///< standard deviation across the edge
};

/// All points of one model edge in one image, reduced to a straight line: its position at two places whose
/// errors are independent (at one place if the points coincide).
struct ObservedLine {
  int edge = 0, camera = 0, n = 2;
  Eigen::Vector2d at[2];  ///< on the line that fits the points best [px]
  double sigma_px = 0;    ///< standard deviation across the line, at each place
};

/// Fits the lines; observations of one line must follow each other.
std::vector<ObservedLine> ObservedLines(std::span<const EdgeObservation> observations);

/// Distance of an image point from a projected model edge, with its Jacobians.
struct EdgeResidual {
  int edge = 0, camera = 0;
  double distance_px = 0;
  double variance = 0;                  ///< variance of the measurement [px^2]
  Eigen::Matrix<double, 1, 6> by_pose;  ///< Jacobian by (x, y, z, roll, pitch, yaw) as in PoseJacobian
  Eigen::Matrix<double, 1, 6> by_base;  ///< Jacobian by a motion of space about the origin of base
  /// Jacobian by shift (u, v), roll and scale of the image [px at kCameraLever_px].
  Eigen::Vector4d by_camera;
  Eigen::Vector3d across;  ///< Jacobian by a shift of the model edge; its part along the edge is 0
  double lever = 0;        ///< place on the model edge: -1 at one end, 1 at the other
};

inline constexpr double kCameraLever_px =
    300;  ///< roll and scale are counted in pixels that far from the centre

/// The residual of the image point `at` [undistorted px] for the model edge at `base_from_landmark`; nullopt
/// if the edge lies behind the camera or is seen end-on.
std::optional<EdgeResidual> ResidualOf(const CameraModel& camera, const Eigen::Isometry3d& base_from_landmark,
                                       const LandmarkEdge& edge, const Eigen::Vector2d& at);

}  // namespace priamos::head
