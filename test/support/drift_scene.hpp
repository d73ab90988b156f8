#pragma once

#include <vector>

#include "common/random.hpp"
#include "head/core/drift/stereo_drift.hpp"

namespace priamos::test {

/// A stereo head before a door, without images: points on the door's edges as both cameras see them.
class DriftScene {
 public:
  /// How far the world differs from what the head believes, one sigma each.
  struct Errors {
    double model_m = 0.001, tilt_m = 0.00025;  ///< of every edge
    double calibration_px = 0.06;              ///< of each camera: shift, roll and scale
    double edge_px = 0.05, point_px = 0.1;     ///< of half an edge, of every point
  };

  /// Draws the errors that stay the same from look to look.
  DriftScene(const Errors& errors, Rng& rng);

  /// Turns the true right camera about its x right, y down, z forward.
  void TurnRight(const Eigen::Vector3d& turn_rad);

  /// One look from a pose `base_from_landmark`; the model's own errors stay unknown to the head.
  std::vector<head::EdgeObservation> Look(const Pose2& base_from_landmark, Rng& rng) const;

  const head::LandmarkModel& model() const { return model_; }           ///< as the head believes
  const head::CameraModel& camera(int i) const { return cameras_[i]; }  ///< as the head believes

 private:
  Errors errors_;
  head::LandmarkModel model_, true_model_;
  head::CameraModel cameras_[2], true_cameras_[2];
};

}  // namespace priamos::test
