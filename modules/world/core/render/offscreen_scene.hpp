#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>

#include "common/image_size.hpp"
#include "world/core/render/mesh.hpp"

namespace priamos::world {

/// A pinhole picture to be drawn. Pixel (0,0) covers [0,1) x [0,1) and is sampled in its middle: unlike
/// elsewhere in the project, centre_px counts from the corner of the image.
struct PinholeView {
  Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();  ///< x right, y down, z forward
  Eigen::Vector2d focal_px{1000, 1000};
  Eigen::Vector2d centre_px{ImageSize{}.width / 2.0, ImageSize{}.height / 2.0};
};

/// A mesh in graphics memory, drawn off-screen with mrpt::opengl::CFBORender. To be used and destroyed in the
/// thread that made it; all of a thread share one OpenGL context and one picture size.
/// Throws std::runtime_error when there is no off-screen OpenGL.
class OffscreenScene {
 public:
  OffscreenScene(int width_px, int height_px);
  ~OffscreenScene();

  void SetTextures(const std::vector<cv::Mat>& layers);
  void SetMesh(const Mesh& mesh);
  /// Draws near things first from here on, which saves half of the time.
  void SortFrom(const Eigen::Vector3d& map_eye);

  /// Draws the picture: CV_8UC3, channel 2 is albedo times light, channel 1 the retro-reflected share,
  /// channel 0 the laser line. The image is valid until the next call.
  const cv::Mat& Render(const PinholeView& view);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Keeps the OpenGL context of this thread: scenes made one after the other then start in a fifth of the
/// time.
std::shared_ptr<void> HoldGraphics(int width_px, int height_px);

}  // namespace priamos::world
