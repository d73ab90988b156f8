#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "common/archive.hpp"
#include "common/robot/robot_drawing.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/head_setting.hpp"
#include "head/core/camera/laser_plane.hpp"
#include "head/core/camera/lens_table.hpp"

namespace priamos::head {

/// The cameras by their numbers in messages; the third one is between and above the other two.
enum Camera : int { kLeft = 0, kRight = 1, kThird = 2 };
inline constexpr int kCameras = 3;
inline constexpr const char* kCameraNames[kCameras] = {"left", "right", "third"};

/// Mounting of one camera on the platform: REP 103 axes, x forward. The platform's origin is on the tilt
/// axis.
struct CameraMount {
  double x_m = 0, y_m = 0, z_m = 0;              ///< vergence axis, and height of the camera on it
  double axis_roll_rad = 0, axis_pitch_rad = 0;  ///< tilt of the vergence axis
  double side_m = 0;                             ///< offset of the camera from its vergence axis, to the left
  /// Orientation of the camera on its axis; pitch positive looks down.
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;

  void Describe(Archive& a);
};

/// The mechanics of KASTOR: pan axis on the base, tilt axis on it, cameras on the tilting platform. The
/// numbers start as those of the drawing and end as those of the calibration.
struct HeadGeometry {
  /// The pan axis, and on it the point nearest to the tilt axis: the origin of the head (section 3.1.3 of
  /// the paper: the intersection of both axes).
  double x_m = kDrawnHead.x_m, y_m = kDrawnHead.y_m, z_m = kDrawnHead.z_m;
  /// Orientation of the pan axis; yaw is the zero of the pan.
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
  double tilt_axis_x_m = 0;       ///< offset of the tilt axis along x of the pan platform
  double tilt_axis_roll_rad = 0;  ///< tilt of the tilt axis about x of the pan platform
  std::array<CameraMount, kCameras> cameras = NominalMounts();

  void Describe(Archive& a);
  static std::array<CameraMount, kCameras> NominalMounts();

  /// Pose of a camera (axes x right, y down, z forward) with its centre of projection `pupil_m` before its
  /// mounting point. Angles of the motors; the third camera has no vergence.
  Eigen::Isometry3d BaseFromCamera(const HeadSetting& setting, int camera, double pupil_m) const;
  /// Pose of the head's origin, which no motor moves, in the base frame.
  Eigen::Isometry3d BaseFromHead() const;
};

/// P(pan, tilt, vergence, zoom, focus) of all three cameras.
struct HeadModel {
  HeadGeometry geometry;
  std::array<LensTable, kCameras> lenses;  ///< the third camera's has a single node
  std::vector<LaserPlane> lasers;          ///< light planes of the line lasers that were calibrated
  /// Covariance of the error that all cameras share at every setting, as a small motion of space about the
  /// origin of base (x, y, z, roll, pitch, yaw) [m, rad]. Most of it is the placement error of the reference
  /// object.
  Eigen::Matrix<double, 6, 6> base_covariance = Eigen::Matrix<double, 6, 6>::Zero();

  /// The calibrated camera at a setting, in the base frame. Refuses zoom and focus that were not calibrated.
  Outcome<CameraModel> CameraAt(const HeadSetting& setting, int camera) const;
};

/// HeadModel::base_covariance for a reference object at `at_m` [base frame] whose position and orientation
/// have these standard deviations on each axis.
Eigen::Matrix<double, 6, 6> PlacementCovariance(const Eigen::Vector3d& at_m, double place_sigma_m,
                                                double turn_sigma_rad);

/// The camera model from the state of its lens and its pose.
CameraModel MakeCameraModel(const LensState& lens, const Eigen::Isometry3d& base_from_camera);

}  // namespace priamos::head
