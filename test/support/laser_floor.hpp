#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "common/frame_store.hpp"
#include "common/random.hpp"
#include "head/core/camera/camera_model.hpp"
#include "head/core/camera/laser_plane.hpp"

namespace priamos::support {

/// A box on the floor, or (negative height) a pit in it, base frame; its sides face x and y.
struct FloorStep {
  double x_from = 0, x_to = 0, y_from = 0, y_to = 0, height_m = 0;
  double albedo = 1;  ///< against the floor's
};

/// The floor before the robot with the lasers' lines on it: exact places of the lines, simple looks. Much
/// faster than world's renderer, with which it shares no code.
struct LaserFloor {
  head::CameraModel camera;
  std::vector<head::LaserPlane> lasers;
  Eigen::Vector3d source{0.46, 0, 0.60};  ///< of the fans, in the lasers' planes
  double half_angle_rad = 0.6;
  double heave_m = 0, pitch_rad = 0, roll_rad = 0;  ///< floor: z = heave + pitch x + roll y
  std::vector<FloorStep> steps;
  double amplitude = 110;             ///< of the line on the floor [grey levels]
  double speckle = 0.2;               ///< relative variation of the line
  double speckle_px = 0.06;           ///< and of its place, alike over a few columns
  double background = 60, noise = 2;  ///< [grey levels]
  const cv::Mat* texture = nullptr;   ///< CV_32FC1, added; at least as large as the picture
  int width = 768, height = 576;
};

/// The third camera of the drawing, tilted to see the line in the middle of its picture, and the near laser.
LaserFloor NominalLaserFloor();
/// The same with both lasers, and the line of the far one as far above the middle as the other below it.
LaserFloor NominalLaserPair();

/// A level fan from `source` that meets the floor `distance_m` before the base.
head::LaserPlane FanTo(double distance_m, const Eigen::Vector3d& source);
/// The third camera of the drawing.
head::CameraModel ThirdCamera(double tilt_rad);

GreyImage Render(const LaserFloor& scene, Rng& rng);

/// A floor covering: grain, blotches, joints of tiles or boards, and reflections of lamps.
cv::Mat FloorTexture(Rng& rng, int width = 1100, int height = 800);

}  // namespace priamos::support
