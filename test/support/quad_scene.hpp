#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "common/random.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::test {

/// A flat parallelogram of one grey value: corner + a * u + b * v, a and b in [0, 1] [m].
struct Quad {
  Eigen::Vector3d corner, u, v;
  double grey = 128;
  bool is_triangle = false;  ///< only where a + b is at most 1
};

/// Pictures of quads for tests of seeing: exact to about 1/100 px by area sampling with 8 x 8 samples in
/// every pixel that an edge crosses, through the camera's DLT matrix and its distortion. `base_from_scene`
/// places the scene; what no quad covers is `background`.
cv::Mat RenderQuads(const std::vector<Quad>& quads, const Eigen::Isometry3d& base_from_scene,
                    const head::CameraModel& camera, double noise, Rng& rng, double background = 60);

/// A door in a wall as config/sim/maps/door.toml has it, in the landmark frame, with what lies behind.
std::vector<Quad> DoorQuads(double width_m = 0.90, double frame_m = 0.06);
/// Its edge skeleton, as the planner's map models it.
head::LandmarkModel DoorModel(double width_m = 0.90);
/// The wall alone.
std::vector<Quad> WallQuads();

/// A camera of the KASTOR head: `pan_rad` of the platform, `side` +1 left or -1 right, at the nominal place.
head::CameraModel HeadCamera(double pan_rad, int side, double focal_px = 1000, double k1 = 0);

}  // namespace priamos::test
