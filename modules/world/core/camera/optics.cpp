#include "world/core/camera/optics.hpp"

#include <cmath>
#include <string>

#include "common/random.hpp"

namespace priamos::world {

namespace {

constexpr double kMotorRange = 2000;  // steps of zoom and focus
constexpr double kMastFoot_m = 0.6;   // where the mast is bolted to the deck
constexpr double kFarOff_px = 200;    // a principal point farther from the middle is a mistake in the file

Eigen::Isometry3d Translate(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// Yaw, then pitch (positive looks down), then roll: REP 103 axes.
Eigen::Isometry3d Turn(double roll, double pitch, double yaw) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return Eigen::Isometry3d(AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(pitch, Vector3d::UnitY()) *
                           AngleAxisd(roll, Vector3d::UnitX()));
}

/// Camera axes x right, y down, z forward in a body frame x forward, y left, z up.
Eigen::Isometry3d BodyFromOptical() {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return t;
}

/// The mast's lean about its foot.
Eigen::Isometry3d Lean(const HeadBuild& b, const MastLean& lean) {
  if (lean.pitch_rad == 0 && lean.roll_rad == 0) return Eigen::Isometry3d::Identity();
  return Translate(b.x_m, b.y_m, kMastFoot_m) * Turn(lean.roll_rad, lean.pitch_rad, 0) *
         Translate(-b.x_m, -b.y_m, -kMastFoot_m);
}

Eigen::Isometry3d BaseFromPlatform(const HeadBuild& b, const HeadAxes& axes) {
  return Lean(b, axes.lean) * Translate(b.x_m, b.y_m, b.z_m) * Turn(b.roll_rad, b.pitch_rad, b.yaw_rad) *
         Turn(0, 0, axes.pan_rad) * Translate(b.tilt_axis_x_m, 0, b.tilt_axis_z_m) *
         Turn(b.tilt_axis_roll_rad, 0, b.tilt_axis_yaw_rad) * Turn(0, axes.tilt_rad, 0);
}

/// Zoom and focus as fractions 0..1; the third camera has neither motor: middle zoom, focus of the others.
struct LensState {
  double zoom = 0.5, focus = 0.8;
};

LensState LensOf(Camera camera, const HeadAxes& axes) {
  if (camera == kThirdCamera) return {};
  return {axes.zoom_step[camera] / kMotorRange, axes.focus_step[camera] / kMotorRange};
}

void SetIntrinsics(const CameraBuild& build, const LensState& lens, TrueCamera& camera) {
  const double ratio = build.focal_max_px / build.focal_min_px;
  camera.focal_px =
      build.focal_min_px * std::pow(ratio, lens.zoom) * (1 + build.breathing * (1 - lens.focus));
  camera.centre_px = {build.centre_u_px + (lens.zoom - 0.5) * build.centre_walk_u_px,
                      build.centre_v_px + (lens.zoom - 0.5) * build.centre_walk_v_px};
  camera.k1 = build.k1_wide + lens.zoom * (build.k1_tele - build.k1_wide);
  camera.k2 = build.k2 * (1 - lens.zoom);
  camera.k3 = build.k3;
  camera.p1 = build.p1;
  camera.p2 = build.p2;
  camera.focus_dioptre = (1 - lens.focus) / build.nearest_focus_m;
}

}  // namespace

TrueCamera CameraAt(const HeadBuild& build, Camera camera, const HeadAxes& axes) {
  const CameraBuild& c = build.cameras[camera];
  const double vergence = camera == kThirdCamera ? 0 : axes.vergence_rad[camera];
  TrueCamera result;
  SetIntrinsics(c, LensOf(camera, axes), result);
  // The entrance pupil wanders forward as the lens gets longer: the centre of projection is not a point of
  // the camera's housing.
  const double mid = std::sqrt(c.focal_min_px * c.focal_max_px);
  const double pupil = c.pupil_m * result.focal_px / mid;
  result.base_from_camera = BaseFromPlatform(build, axes) * Translate(c.x_m, c.y_m, c.z_m) *
                            Turn(0, 0, vergence) * Turn(c.roll_rad, c.pitch_rad, c.yaw_rad) *
                            Translate(pupil, 0, 0) * BodyFromOptical();
  return result;
}

Eigen::Vector2d TrueCamera::ProjectPinhole(const Eigen::Vector3d& in_camera) const {
  return centre_px + focal_px * in_camera.head<2>() / in_camera.z();
}

Eigen::Vector2d TrueCamera::Distort(const Eigen::Vector2d& undistorted_px) const {
  const Eigen::Vector2d d = undistorted_px - centre_px;
  const double r2 = d.squaredNorm() / (focal_px * focal_px);
  const Eigen::Vector2d radial = centre_px + d * (1 + r2 * (k1 + (k2 + k3 * r2) * r2));
  if (p1 == 0 && p2 == 0) return radial;
  const Eigen::Vector2d n = d / focal_px;
  const double xy = 2 * n.x() * n.y();
  return radial + focal_px * Eigen::Vector2d(p1 * xy + p2 * (r2 + 2 * n.x() * n.x()),
                                             p1 * (r2 + 2 * n.y() * n.y()) + p2 * xy);
}

Eigen::Vector2d TrueCamera::Undistort(const Eigen::Vector2d& distorted_px) const {
  Eigen::Vector2d undistorted = UndistortRadially(distorted_px);
  if (p1 == 0 && p2 == 0) return undistorted;
  for (int i = 0; i < 8; ++i) undistorted -= Distort(undistorted) - distorted_px;
  return undistorted;
}

Eigen::Vector2d TrueCamera::UndistortRadially(const Eigen::Vector2d& distorted_px) const {
  const Eigen::Vector2d d = distorted_px - centre_px;
  const double target = d.norm() / focal_px;
  if (target == 0) return distorted_px;
  double r = target;
  for (int i = 0; i < 20; ++i) {
    const double r2 = r * r;
    const double error = r * (1 + r2 * (k1 + (k2 + k3 * r2) * r2)) - target;
    r -= error / (1 + r2 * (3 * k1 + (5 * k2 + 7 * k3 * r2) * r2));
    if (std::abs(error) < 1e-15) break;
  }
  return centre_px + d * (r / target);
}

Eigen::Vector2d TrueCamera::Project(const Eigen::Vector3d& in_base) const {
  return Distort(ProjectPinhole(base_from_camera.inverse() * in_base));
}

Eigen::Isometry3d Lift(const Pose2& a_from_b) {
  return Translate(a_from_b.x, a_from_b.y, 0) * Turn(0, 0, a_from_b.yaw);
}

void CameraBuild::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -1, 1, "vergence axis on the platform, forward"});
  a.Number("y_m", y_m, {"m", -1, 1, "vergence axis on the platform, left"});
  a.Number("z_m", z_m, {"m", -1, 1, "vergence axis on the platform, up"});
  a.Number("roll_rad", roll_rad, {"rad", -0.5, 0.5, "mounting error about the viewing direction"});
  a.Number("pitch_rad", pitch_rad, {"rad", -1.5, 1.5, "mounting, positive looks down"});
  a.Number("yaw_rad", yaw_rad, {"rad", -0.5, 0.5, "mounting, positive looks left"});
  a.Number("pupil_m", pupil_m, {"m", -0.2, 0.2, "entrance pupil before the vergence axis at middle zoom"});
  a.Number("focal_min_px", focal_min_px, {"px", 200, 5000, "focal length at zoom step 0"});
  a.Number("focal_max_px", focal_max_px, {"px", 200, 5000, "focal length at zoom step 2000"});
  a.Number("centre_u_px", centre_u_px,
           {"px", kImageWidth_px / 2.0 - kFarOff_px, kImageWidth_px / 2.0 + kFarOff_px,
            "principal point at middle zoom, column"});
  a.Number("centre_v_px", centre_v_px,
           {"px", kImageHeight_px / 2.0 - kFarOff_px, kImageHeight_px / 2.0 + kFarOff_px,
            "principal point at middle zoom, row"});
  a.Number("centre_walk_u_px", centre_walk_u_px, {"px", -50, 50, "how far it moves over the zoom range"});
  a.Number("centre_walk_v_px", centre_walk_v_px, {"px", -50, 50, "how far it moves over the zoom range"});
  a.Number("k1_wide", k1_wide, {"-", -0.15, 0.15, "radial distortion at zoom step 0"});
  a.Number("k1_tele", k1_tele, {"-", -0.15, 0.15, "radial distortion at zoom step 2000"});
  a.Number("k2", k2, {"-", -0.1, 0.1, "radial distortion of fifth order at zoom step 0"});
  a.Number("p1", p1, {"-", -0.01, 0.01, "tangential distortion"});
  a.Number("p2", p2, {"-", -0.01, 0.01, "tangential distortion"});
  a.Number("k3", k3, {"-", -0.3, 0.3, "radial distortion of seventh order"});
  a.Number("breathing", breathing,
           {"-", -0.1, 0.1, "growth of the focal length from infinity to nearest focus"});
  a.Number("nearest_focus_m", nearest_focus_m, {"m", 0.1, 5, "distance in focus at focus step 0"});
}

std::array<CameraBuild, kCameras> HeadBuild::NominalCameras() {
  std::array<CameraBuild, kCameras> cameras;
  cameras[kLeftCamera].y_m = kDrawnHead.half_stereo_base_m;
  cameras[kRightCamera].y_m = -kDrawnHead.half_stereo_base_m;
  cameras[kThirdCamera].z_m = kDrawnHead.third_above_m;
  cameras[kThirdCamera].focal_min_px = cameras[kThirdCamera].focal_max_px = 900;
  return cameras;
}

void HeadBuild::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -1, 1, "pan axis in the base frame, forward"});
  a.Number("y_m", y_m, {"m", -1, 1, "pan axis in the base frame, left"});
  a.Number("z_m", z_m, {"m", 0, 3, "tilt axis above the floor, nominally"});
  a.Number("roll_rad", roll_rad, {"rad", -0.2, 0.2, "lean of the pan axis to the right"});
  a.Number("pitch_rad", pitch_rad, {"rad", -0.2, 0.2, "lean of the pan axis to the front"});
  a.Number("yaw_rad", yaw_rad, {"rad", -0.2, 0.2, "zero of the pan axis"});
  a.Number("tilt_axis_x_m", tilt_axis_x_m, {"m", -0.2, 0.2, "tilt axis before the pan axis"});
  a.Number("tilt_axis_z_m", tilt_axis_z_m, {"m", -0.2, 0.2, "tilt axis above its nominal height"});
  a.Number("tilt_axis_roll_rad", tilt_axis_roll_rad,
           {"rad", -0.2, 0.2, "skew of the tilt axis, left side up"});
  a.Number("tilt_axis_yaw_rad", tilt_axis_yaw_rad,
           {"rad", -0.2, 0.2, "skew of the tilt axis about the pan axis"});
  a.Section("left", cameras[kLeftCamera], "left camera");
  a.Section("right", cameras[kRightCamera], "right camera");
  a.Section("third", cameras[kThirdCamera], "third, passive camera");
}

HeadBuild HeadBuild::Specimen(std::uint64_t seed) {
  constexpr double kPlace_m = 0.0005, kAngle_rad = 0.004;
  Rng rng = Rng::Stream(seed, "head build");
  HeadBuild b;
  for (double* place : {&b.x_m, &b.y_m, &b.z_m, &b.tilt_axis_x_m, &b.tilt_axis_z_m})
    *place += rng.Normal(kPlace_m);
  for (double* angle : {&b.roll_rad, &b.pitch_rad, &b.yaw_rad, &b.tilt_axis_roll_rad, &b.tilt_axis_yaw_rad}) {
    *angle += rng.Normal(kAngle_rad / 2);
  }
  for (CameraBuild& c : b.cameras) {
    for (double* place : {&c.x_m, &c.y_m, &c.z_m, &c.pupil_m}) *place += rng.Normal(kPlace_m);
    for (double* angle : {&c.roll_rad, &c.pitch_rad, &c.yaw_rad}) *angle += rng.Normal(kAngle_rad);
    const double scale = 1 + rng.Normal(0.004);
    c.focal_min_px *= scale;
    c.focal_max_px *= scale;
    c.centre_u_px += rng.Normal(6);
    c.centre_v_px += rng.Normal(6);
    c.centre_walk_u_px = rng.Normal(4);
    c.centre_walk_v_px = rng.Normal(4);
    c.k1_wide += rng.Normal(0.004);
    c.k1_tele += rng.Normal(0.004);
  }
  return b;
}

}  // namespace priamos::world
