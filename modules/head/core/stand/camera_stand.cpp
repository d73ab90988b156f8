#include "head/core/stand/camera_stand.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {

Eigen::Isometry3d BaseFromCamera(const CameraStand& stand) {
  Eigen::Matrix3d level;  // axes of an upright camera in the base frame
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d base_from_camera(Eigen::Translation3d(0, 0, stand.height_m));
  base_from_camera.rotate(Eigen::AngleAxisd(stand.tilt_rad, Eigen::Vector3d::UnitY()) *
                          Eigen::AngleAxisd(stand.roll_rad, Eigen::Vector3d::UnitX()));
  base_from_camera.rotate(level);
  return base_from_camera;
}

CameraStand StandOf(const Eigen::Vector3d& up, double height_m) {
  return {height_m, std::asin(std::clamp(-up.z(), -1.0, 1.0)), std::atan2(-up.x(), -up.y())};
}

Eigen::Matrix2d TiltAndRollCovariance(const VerticalDirection& vertical) {
  const Eigen::Vector3d& up = vertical.up;
  const double across = up.head<2>().squaredNorm();
  Eigen::Matrix<double, 2, 3> j;
  j << 0, 0, -1 / std::sqrt(across), up.y() / across, -up.x() / across, 0;
  return j * vertical.covariance * j.transpose();
}

CameraModel OnTheFloor(CameraModel camera, const CameraStand& stand) {
  camera.image_from_base = (camera.image_from_base * BaseFromCamera(stand).inverse().matrix()).eval();
  return camera;
}

CameraView SeenFrom(CameraView view, const CameraModel& camera) {
  view.camera = &camera;
  for (ViewLine& line : view.lines) {
    line.plane = camera.image_from_base.transpose() *
                 Eigen::Vector3d(line.normal.x(), line.normal.y(), -line.normal.dot(line.p));
    line.plane /= line.plane.head<3>().norm();
  }
  return view;
}

}  // namespace priamos::head
