#include "test/bench/vision/scene/eyes.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "head/core/camera/projection.hpp"
#include "world/core/camera/optics.hpp"

namespace priamos::bench {
namespace {

constexpr double kHidden_m = 0.015;  // something stands so far before it

double Behind(const Eyes& eyes, const head::CameraModel& camera, const Eigen::Vector3d& in_base) {
  const Eigen::Isometry3d map = world::Lift(eyes.map_from_base);
  const Eigen::Vector3d eye = map * head::OpticalCentre(camera), direction = map * in_base - eye;
  return eyes.scene.Distance(eye, direction.normalized(), direction.norm() + 1) - direction.norm();
}

}  // namespace

bool Eyes::InPicture(const Eigen::Vector3d& in_base, double border) const {
  return std::all_of(cameras.begin(), cameras.end(), [&](const head::CameraModel& camera) {
    if (camera.Depth(in_base) <= 0) return false;
    const Eigen::Vector2d px = camera.Distort(camera.Project(in_base));
    return px.x() > border && px.x() < world::kImageWidth_px - 1 - border && px.y() > border &&
           px.y() < world::kImageHeight_px - 1 - border;
  });
}

bool Eyes::Visible(const Eigen::Vector3d& in_base) const {
  return std::all_of(cameras.begin(), cameras.end(), [&](const head::CameraModel& camera) {
    return Behind(*this, camera, in_base) > -kHidden_m;
  });
}

double Eyes::SurfaceBehind(const Eigen::Vector3d& in_base) const {
  return Behind(*this, cameras[0], in_base);
}

}  // namespace priamos::bench
