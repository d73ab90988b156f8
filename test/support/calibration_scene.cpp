#include "test/support/calibration_scene.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "test/support/disc_renderer.hpp"

namespace priamos::support {

namespace {

using Eigen::Vector3d;

bool Hits(const ReferenceBlock& block, const Vector3d& from, const Vector3d& to) {
  double enter = 1e-6, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = block.centre_m[axis] - block.size_m[axis] / 2 - from[axis];
    const double high = low + block.size_m[axis], step = to[axis] - from[axis];
    if (std::abs(step) < 1e-12) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / step, high / step));
    leave = std::min(leave, std::max(low / step, high / step));
  }
  return enter < leave;
}

bool InImage(const head::CameraModel& camera, const ReferenceObject& object) {
  return std::all_of(object.discs.begin(), object.discs.end(), [&](const ReferenceDisc& disc) {
    const auto ellipse = head::ProjectDisc(camera.image_from_base, disc);
    if (!ellipse) return false;
    const double margin = ellipse->SemiMajor() + 8;
    const Eigen::Vector2d px = camera.Distort(ellipse->centre_px);
    return px.x() > margin && px.x() < 767 - margin && px.y() > margin && px.y() < 575 - margin;
  });
}

}  // namespace

ReferenceObject ShippedReferenceObject() {
  return LoadConfig<ReferenceObject>(PRIAMOS_SOURCE_DIR "/config/sim/reference_object.toml");
}

head::CameraModel MakeCamera(const CameraView& view) {
  const double ca = std::cos(view.azimuth_rad), sa = std::sin(view.azimuth_rad);
  const double ce = std::cos(view.elevation_rad), se = std::sin(view.elevation_rad);
  const Vector3d eye = view.target_m + view.distance_m * Vector3d(ca * ce, sa * ce, se);
  const Vector3d forward = (view.target_m - eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d camera_from_object;
  camera_from_object << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  const Vector3d aim(view.target_offset_px.x() / view.focal_px, view.target_offset_px.y() / view.focal_px, 1);
  camera_from_object = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), aim) *
                       Eigen::AngleAxisd(view.roll_rad, Vector3d::UnitZ()) * camera_from_object;
  Eigen::Matrix3d k;
  k << view.focal_px, 0, view.centre_px.x(), 0, view.focal_px, view.centre_px.y(), 0, 0, 1;
  head::CameraModel camera;
  camera.image_from_base << k * camera_from_object, -k * camera_from_object * eye;
  camera.centre_px = view.centre_px;
  camera.scale_px = view.focal_px;
  camera.k1 = view.k1;
  camera.k2 = view.k2;
  return camera;
}

CameraView RandomView(Rng& rng) {
  static const ReferenceObject object = ShippedReferenceObject();
  for (;;) {
    CameraView view;
    view.focal_px = rng.Uniform(800, 1600);
    view.distance_m = rng.Uniform(1, 4);
    view.azimuth_rad = Radians(rng.Uniform(-35, 35));
    view.elevation_rad = Radians(rng.Uniform(-35, 35));
    view.roll_rad = Radians(rng.Uniform(-35, 35));
    view.target_offset_px = {rng.Uniform(-250, 250), rng.Uniform(-180, 180)};
    view.centre_px += Eigen::Vector2d(rng.Normal(5), rng.Normal(5));
    view.k1 = rng.Uniform(-0.08, 0.02);
    if (InImage(MakeCamera(view), object)) return view;
  }
}

bool Unhidden(const ReferenceObject& object, const ReferenceDisc& disc, const Vector3d& eye_m) {
  const Vector3d e1 = disc.normal.unitOrthogonal(), e2 = disc.normal.cross(e1);
  for (int i = 0; i < 16; ++i) {
    const double t = 2 * kPi * i / 16;
    const Vector3d rim =
        disc.centre_m + 1e-5 * disc.normal + 1.1 * disc.radius_m * (std::cos(t) * e1 + std::sin(t) * e2);
    for (const ReferenceBlock& block : object.blocks) {
      if (Hits(block, rim, eye_m)) return false;
    }
  }
  return true;
}

Sightings Sight(const ReferenceObject& object, const head::CameraModel& camera, int hidden, int clutter,
                Rng& rng) {
  std::vector<std::pair<int, head::DetectedDisc>> all;
  for (std::size_t i = 0; i < object.discs.size(); ++i) {
    if (!Unhidden(object, object.discs[i], EyeOf(camera))) continue;
    head::DetectedDisc d;
    d.ellipse = *head::ProjectDisc(camera.image_from_base, object.discs[i]);
    d.ellipse.centre_px = *head::ProjectDiscCentroid(camera, object.discs[i]) +
                          Eigen::Vector2d(rng.Normal(0.02), rng.Normal(0.02));
    d.ellipse.shape_px2 *= 1 + rng.Normal(0.01);
    d.ellipse.shape_px2(0, 0) *= 1 + rng.Normal(0.01);
    d.amplitude = 150;
    all.emplace_back(static_cast<int>(i), d);
  }
  while (static_cast<int>(object.discs.size() - all.size()) < hidden) {
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(rng.Below(all.size())));
  }
  Sightings sightings;
  sightings.visible = static_cast<int>(all.size());
  for (int i = 0; i < clutter; ++i) {
    head::DetectedDisc d;
    const double radius = rng.Uniform(3, 25), ratio = rng.Uniform(0.6, 1);
    d.ellipse.centre_px = {rng.Uniform(30, 730), rng.Uniform(30, 540)};
    d.ellipse.shape_px2 = Eigen::Vector2d(radius * radius, radius * radius * ratio * ratio).asDiagonal();
    d.amplitude = rng.Uniform(60, 200);
    all.emplace_back(-1, d);
  }
  std::shuffle(all.begin(), all.end(), rng.engine());
  for (const auto& [disc, detection] : all) {
    sightings.truth.push_back(disc);
    sightings.detections.push_back(detection);
  }
  return sightings;
}

GreyImage RenderSightings(const ReferenceObject& object, const head::CameraModel& camera,
                          const std::vector<int>& truth, Rng& rng) {
  DiscRenderer scene(768, 576, rng.Uniform(10, 60), 1);
  const double amplitude = rng.Uniform(60, 190);
  for (std::uint64_t i = rng.Below(12); i > 0; --i) {
    const double u = rng.Uniform(30, 700), v = rng.Uniform(30, 500), radius = rng.Uniform(3, 25);
    if (rng.Chance(0.3)) {
      scene.AddRectangle(u, v, u + rng.Uniform(5, 60), v + rng.Uniform(5, 60), amplitude);
    } else {
      const double minor = radius * rng.Uniform(0.6, 1);
      scene.AddEllipse({{u, v}, Eigen::Vector2d(radius * radius, minor * minor).asDiagonal()},
                       rng.Uniform(60, 190));
    }
  }
  // The black body around every disc hides what lies behind.
  for (const int disc : truth) {
    const head::Ellipse e = *head::ProjectDisc(camera.image_from_base, object.discs[disc]);
    const Eigen::Vector2d c = camera.Distort(e.centre_px);
    const double reach = e.SemiMajor() + 6;
    scene.Cover(c.x() - reach, c.y() - reach, c.x() + reach, c.y() + reach, 20);
  }
  for (const int disc : truth) scene.AddDisc(camera, object.discs[disc], amplitude);
  return scene.Expose({rng.Uniform(0.4, 1.2), 2}, rng);
}

Vector3d EyeOf(const head::CameraModel& camera) {
  return -camera.image_from_base.leftCols<3>().inverse() * camera.image_from_base.col(3);
}

}  // namespace priamos::support
