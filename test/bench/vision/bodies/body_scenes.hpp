#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <string>

#include "common/random.hpp"
#include "head/core/bodies/polyhedron.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::bench {

/// What is drawn and how it is photographed.
struct BodySceneOptions {
  double blur_px = 0;        ///< of the lens, beyond that of the pixels [px]
  double model_error_m = 0;  ///< each corner of the model is off by so much, each axis, 1 sigma
  bool is_absent = false;    ///< the body is not there
  bool is_another = false;   ///< a body of the same kind, but of other proportions, is there instead
};

/// A photograph of a body among others; base is the camera's own frame (x right, y down, z forward).
struct BodyScene {
  std::string kind;
  cv::Mat image;
  head::CameraModel camera;
  head::Polyhedron model;
  Eigen::Isometry3d truth;  ///< base_from_model
};

/// A box, an angle, a stair, a house, a channel or a wedge with labels on it, on a floor with papers and
/// other bodies, 0.5 to 3 m before a camera of any usual lens.
BodyScene DrawBody(const BodySceneOptions& options, std::uint64_t seed);

/// The pose moved by `shift_m` and turned by `turn_rad`, both in random directions.
Eigen::Isometry3d Beside(const Eigen::Isometry3d& pose, double shift_m, double turn_rad, Rng& rng);

}  // namespace priamos::bench
