#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/image_size.hpp"
#include "common/robot/robot_drawing.hpp"

namespace priamos::world {

inline constexpr int kImageWidth_px = ImageSize{}.width, kImageHeight_px = ImageSize{}.height;
inline constexpr int kCameras = 3;
/// The cameras by their numbers in messages.
enum Camera : int { kLeftCamera = 0, kRightCamera = 1, kThirdCamera = 2 };

/// How far the mast below the head leans, base frame: positive pitch looks down, positive roll leans to the
/// right.
struct MastLean {
  double pitch_rad = 0, roll_rad = 0;
};

/// True positions of the axes of KASTOR, backlash included; the step counters are not known here.
/// Signs as in head_command_t: pan and vergence positive to the left, tilt positive looks down.
struct HeadAxes {
  double pan_rad = 0, tilt_rad = 0;
  std::array<double, 2> vergence_rad{};          ///< left and right camera on the platform
  std::array<double, 2> zoom_step{650, 650};     ///< 0 shortest focal length ... 2000 longest
  std::array<double, 2> focus_step{1600, 1600};  ///< 0 nearest distance ... 2000 infinity
  MastLean lean{};
};

/// True geometry of one camera, known to the simulator only.
struct CameraBuild {
  double x_m = 0, y_m = 0, z_m = 0;  ///< camera axis (vergence axis) on the platform
  /// Orientation of the camera on that axis; pitch positive looks down.
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;
  double pupil_m = 0.02;                           ///< entrance pupil before the axis at focal_mid_px
  double focal_min_px = 800, focal_max_px = 1600;  ///< at zoom step 0 and 2000, focused at infinity
  double centre_u_px = ImageSize{}.Centre().x();  ///< column of the principal point at the middle of the zoom
  double centre_v_px = ImageSize{}.Centre().y();  ///< row of the principal point at the middle of the zoom
  double centre_walk_u_px = 0,
         centre_walk_v_px = 0;  ///< shift of the principal point from zoom step 0 to 2000
  double k1_wide = -0.07, k1_tele = -0.02, k2 = 0.01;  ///< radial distortion at zoom step 0 and 2000
  double p1 = 0, p2 = 0;                               ///< tangential distortion
  double k3 = 0;                                       ///< radial distortion of seventh order
  double breathing = 0.012;      ///< relative growth of the focal length at the nearest focus
  double nearest_focus_m = 0.6;  ///< distance in focus at focus step 0

  void Describe(Archive& a);
};

/// The mechanics of KASTOR with their manufacturing errors; without them it is kDrawnHead.
struct HeadBuild {
  double x_m = kDrawnHead.x_m, y_m = kDrawnHead.y_m, z_m = kDrawnHead.z_m;  ///< pan axis in the base frame
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;  ///< orientation of the pan axis, base frame
  double tilt_axis_x_m = 0, tilt_axis_z_m = 0;      ///< tilt axis on the pan platform
  double tilt_axis_roll_rad = 0,
         tilt_axis_yaw_rad = 0;  ///< orientation of the tilt axis relative to the pan axis
  std::array<CameraBuild, kCameras> cameras = NominalCameras();

  void Describe(Archive& a);
  static std::array<CameraBuild, kCameras> NominalCameras();
  /// Head as another specimen would be built: every dimension off by a few tenths of a millimetre and
  /// milliradians, every lens off by a percent and some pixels.
  static HeadBuild Specimen(std::uint64_t seed);
};

/// A camera exactly as it is: the truth that calibration tries to find.
/// Image: u right, v down, (0,0) is the centre of the top left pixel. Camera frame: x right, y down, z
/// forward.
struct TrueCamera {
  Eigen::Isometry3d base_from_camera = Eigen::Isometry3d::Identity();
  double focal_px = 1000;
  Eigen::Vector2d centre_px = ImageSize{}.Centre();
  /// Radial distortion: distorted - centre = (undistorted - centre) (1 + k1 r^2 + k2 r^4 + k3 r^6), r =
  /// |undistorted - centre| / focal_px
  double k1 = 0, k2 = 0, k3 = 0;
  /// Tangential distortion of a lens whose elements are not on one axis, in units of focal_px with (x, y) the
  /// undistorted point: 2 p1 x y + p2 (r^2 + 2 x^2) across, p1 (r^2 + 2 y^2) + 2 p2 x y down (Brown,
  /// "Decentering distortion of lenses", Photogrammetric Engineering 1966).
  double p1 = 0, p2 = 0;
  double focus_dioptre = 0;  ///< inverse of the distance that is sharp [1/m]

  /// The undistorted image point of a point in the camera frame; z must be positive.
  Eigen::Vector2d ProjectPinhole(const Eigen::Vector3d& in_camera) const;
  Eigen::Vector2d Distort(const Eigen::Vector2d& undistorted_px) const;
  Eigen::Vector2d Undistort(const Eigen::Vector2d& distorted_px) const;
  /// The same without the tangential part.
  Eigen::Vector2d UndistortRadially(const Eigen::Vector2d& distorted_px) const;
  /// The exact image of a point of the base frame [distorted px].
  Eigen::Vector2d Project(const Eigen::Vector3d& in_base) const;
};

/// Pose and intrinsics of one camera for a state of the axes.
TrueCamera CameraAt(const HeadBuild& build, Camera camera, const HeadAxes& axes);

/// Pose in the plane, such as map_from_base, as a transform in space.
Eigen::Isometry3d Lift(const Pose2& a_from_b);

}  // namespace priamos::world
