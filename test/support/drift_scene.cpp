#include "test/support/drift_scene.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "head/core/camera/projection.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFocal_px = 900, kLever_px = 300;

Vector3d Somewhere(double sigma, Rng& rng) {
  return {rng.Normal(sigma), rng.Normal(sigma), rng.Normal(sigma)};
}

/// The camera after a turn about its own axes: its matrix is K R, R becomes (turn^T R).
head::CameraModel Turned(head::CameraModel camera, const Vector3d& turn, double scale) {
  Eigen::Matrix3d k;
  k << kFocal_px, 0, camera.centre_px.x(), 0, kFocal_px, camera.centre_px.y(), 0, 0, 1;
  Eigen::Matrix3d back = Eigen::Matrix3d::Identity();
  if (turn.norm() > 0) back = Eigen::AngleAxisd(-turn.norm(), turn.normalized()).toRotationMatrix();
  Eigen::Matrix3d scaled = k;
  scaled(0, 0) *= scale, scaled(1, 1) *= scale;
  camera.image_from_base = scaled * back * k.inverse() * camera.image_from_base;
  return camera;
}

}  // namespace

DriftScene::DriftScene(const Errors& errors, Rng& rng) : errors_(errors), model_(DoorModel()) {
  true_model_ = model_;
  for (head::LandmarkEdge& edge : true_model_.edges) {
    const Vector3d shift = Somewhere(errors.model_m, rng), tilt = Somewhere(errors.tilt_m, rng);
    edge.from += shift - tilt;
    edge.to += shift + tilt;
  }
  for (const int i : {0, 1}) {
    cameras_[i] = HeadCamera(0, i == 0 ? 1 : -1, kFocal_px);
    const double angle = errors.calibration_px / kFocal_px;
    const Vector3d turn(rng.Normal(angle), rng.Normal(angle), rng.Normal(errors.calibration_px / kLever_px));
    true_cameras_[i] = Turned(cameras_[i], turn, 1 + rng.Normal(errors.calibration_px / kLever_px));
  }
}

void DriftScene::TurnRight(const Vector3d& turn_rad) {
  true_cameras_[1] = Turned(true_cameras_[1], turn_rad, 1);
}

std::vector<head::EdgeObservation> DriftScene::Look(const Pose2& base_from_landmark, Rng& rng) const {
  const Eigen::Isometry3d pose = head::Lift(base_from_landmark);
  const Vector2d viewer = base_from_landmark.Inverse().translation();
  std::vector<head::EdgeObservation> observations;
  for (int e = 0; e < static_cast<int>(true_model_.edges.size()); ++e) {
    const head::LandmarkEdge& edge = true_model_.edges[e];
    if (!edge.IsSeenFrom(viewer)) continue;
    for (const int c : {0, 1}) {
      const auto seen = head::ProjectEdge(true_cameras_[c], {}, pose * edge.from, pose * edge.to);
      if (!seen || seen->length_px() < 30) continue;
      const Vector2d shift = seen->normal() * rng.Normal(errors_.edge_px);
      for (double s = 0; s < seen->length_px(); s += 3) {
        observations.push_back(
            {e, c, seen->p + s * seen->direction() + shift + seen->normal() * rng.Normal(errors_.point_px),
             errors_.point_px});
      }
    }
  }
  return observations;
}

}  // namespace priamos::test
