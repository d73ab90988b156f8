#include "head/core/camera/head_model.hpp"

namespace priamos::head {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d Translate(double x, double y, double z) {
  return Isometry3d(Eigen::Translation3d(x, y, z));
}

/// Yaw, then pitch (positive looks down), then roll.
Isometry3d Turn(double roll, double pitch, double yaw) {
  return Isometry3d(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
                    Eigen::AngleAxisd(roll, Vector3d::UnitX()));
}

/// x right, y down, z forward in x forward, y left, z up.
Isometry3d BodyFromOptical() {
  Isometry3d t = Isometry3d::Identity();
  t.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return t;
}

void Angle(Archive& a, const char* key, double& value, const char* doc) {
  a.Number(key, value, {"rad", -0.5, 0.5, doc});
}

}  // namespace

void CameraMount::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -1, 1, "vergence axis on the platform, forward of the tilt axis"});
  a.Number("y_m", y_m, {"m", -1, 1, "vergence axis on the platform, left"});
  a.Number("z_m", z_m, {"m", -1, 1, "camera above the tilt axis"});
  Angle(a, "axis_roll_rad", axis_roll_rad, "vergence axis about x");
  Angle(a, "axis_pitch_rad", axis_pitch_rad, "vergence axis about y");
  a.Number("side_m", side_m, {"m", -0.2, 0.2, "camera left of its vergence axis"});
  Angle(a, "roll_rad", roll_rad, "camera about its viewing direction");
  Angle(a, "pitch_rad", pitch_rad, "camera, positive looks down");
  Angle(a, "yaw_rad", yaw_rad, "camera at vergence 0, positive looks left");
}

std::array<CameraMount, kCameras> HeadGeometry::NominalMounts() {
  std::array<CameraMount, kCameras> mounts;
  mounts[kLeft].y_m = kDrawnHead.half_stereo_base_m;
  mounts[kRight].y_m = -kDrawnHead.half_stereo_base_m;
  mounts[kThird].z_m = kDrawnHead.third_above_m;
  return mounts;
}

void HeadGeometry::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -2, 2, "pan axis in the base frame"});
  a.Number("y_m", y_m, {"m", -2, 2, "pan axis in the base frame"});
  a.Number("z_m", z_m, {"m", 0, 3, "tilt axis in the base frame"});
  Angle(a, "roll_rad", roll_rad, "pan axis about x");
  Angle(a, "pitch_rad", pitch_rad, "pan axis about y");
  Angle(a, "yaw_rad", yaw_rad, "zero of the pan");
  a.Number("tilt_axis_x_m", tilt_axis_x_m,
           {"m", -0.2, 0.2, "offset of the tilt axis along x of the pan platform"});
  Angle(a, "tilt_axis_roll_rad", tilt_axis_roll_rad, "tilt of the tilt axis about x of the pan platform");
  a.Section("left", cameras[kLeft], "left camera");
  a.Section("right", cameras[kRight], "right camera");
  a.Section("third", cameras[kThird], "third camera");
}

Isometry3d HeadGeometry::BaseFromHead() const {
  return Translate(x_m, y_m, z_m) * Turn(roll_rad, pitch_rad, yaw_rad);
}

Isometry3d HeadGeometry::BaseFromCamera(const HeadSetting& setting, int camera, double pupil_m) const {
  const CameraMount& c = cameras[camera];
  const double vergence = camera == kThird ? 0 : setting.vergence_rad[camera];
  return BaseFromHead() * Turn(0, 0, setting.pan_rad) * Translate(tilt_axis_x_m, 0, 0) *
         Turn(tilt_axis_roll_rad, 0, 0) * Turn(0, setting.tilt_rad, 0) * Translate(c.x_m, c.y_m, c.z_m) *
         Turn(c.axis_roll_rad, c.axis_pitch_rad, 0) * Turn(0, 0, vergence) * Translate(0, c.side_m, 0) *
         Turn(c.roll_rad, c.pitch_rad, c.yaw_rad) * Translate(pupil_m, 0, 0) * BodyFromOptical();
}

CameraModel MakeCameraModel(const LensState& lens, const Isometry3d& base_from_camera) {
  Eigen::Matrix3d k;
  k << lens.focal_px, 0, lens.centre_px.x(), 0, lens.focal_px, lens.centre_px.y(), 0, 0, 1;
  CameraModel model;
  model.image_from_base = k * base_from_camera.inverse().matrix().topRows<3>();
  model.centre_px = lens.centre_px;
  model.scale_px = lens.focal_px;
  model.k1 = lens.k1;
  model.k2 = lens.k2;
  return model;
}

Eigen::Matrix<double, 6, 6> PlacementCovariance(const Vector3d& at_m, double place_sigma_m,
                                                double turn_sigma_rad) {
  Eigen::Matrix3d hat;
  hat << 0, -at_m.z(), at_m.y(), at_m.z(), 0, -at_m.x(), -at_m.y(), at_m.x(), 0;
  const double place = place_sigma_m * place_sigma_m, turn = turn_sigma_rad * turn_sigma_rad;
  // A turn about `at_m` is a turn about the origin and a shift by hat * turn.
  Eigen::Matrix<double, 6, 6> covariance;
  covariance << place * Eigen::Matrix3d::Identity() + turn * hat * hat.transpose(), turn * hat,
      turn * hat.transpose(), turn * Eigen::Matrix3d::Identity();
  return covariance;
}

Outcome<CameraModel> HeadModel::CameraAt(const HeadSetting& setting, int camera) const {
  const LensTable& table = lenses[camera];
  // The third camera has no motors: its only node is its lens at any setting.
  const bool fixed = camera == kThird && table.nodes().size() == 1;
  const Outcome<LensState> lens =
      fixed ? Outcome<LensState>(table.nodes().front())
            : table.At(setting.zoom_step[camera % 2], setting.focus_step[camera % 2]);
  if (!lens) return Refusal{lens.reason()};
  return MakeCameraModel(*lens, geometry.BaseFromCamera(setting, camera, lens->pupil_m));
}

}  // namespace priamos::head
