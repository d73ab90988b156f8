#include "world/core/offscreen_scene.hpp"

#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CRenderizable.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "world/core/graphics_mesh.hpp"

namespace priamos::world {

class OffscreenScene::Impl {
 public:
  Impl(int width, int height) : fbo_(width, height), width_(width), height_(height) {
    scene_ = mrpt::opengl::COpenGLScene::Create();
    mesh_ = std::make_shared<GraphicsMesh>();
    scene_->insert(mesh_);
    auto viewport = scene_->getViewport();
    // Its own program only: the stock ones would be compiled for nothing.
    viewport->shaders()[GraphicsMesh::kShader] = GraphicsMesh::CompileProgram();
    viewport->setViewportClipDistances(0.05F, 60.0F);
    viewport->setCustomBackgroundColor({0, 0, 0, 1});
  }

  GraphicsMesh& mesh() { return *mesh_; }

  const cv::Mat& Render(const PinholeView& view) {
    mrpt::img::TCamera pinhole;
    pinhole.ncols = static_cast<std::uint32_t>(width_);
    pinhole.nrows = static_cast<std::uint32_t>(height_);
    pinhole.setIntrinsicParamsFromValues(view.focal_px.x(), view.focal_px.y(), view.centre_px.x(),
                                         view.centre_px.y());
    mrpt::opengl::CCamera camera;
    camera.set6DOFMode(true);
    camera.setProjectiveFromPinhole(pinhole);
    camera.setPose(mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(view.map_from_camera.matrix())));
    // MRPT skips objects whose representative point and box seem out of sight; a room around the camera is
    // not.
    const Eigen::Vector3f ahead = (view.map_from_camera * Eigen::Vector3d(0, 0, 1)).cast<float>();
    mesh_->setLocalRepresentativePoint({ahead.x(), ahead.y(), ahead.z()});
    fbo_.setCamera(*scene_, camera);
    fbo_.render_RGB(*scene_, image_);
    picture_ = image_.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    return picture_;
  }

 private:
  mrpt::opengl::CFBORender fbo_;  // the context: made first, destroyed last
  int width_, height_;
  mrpt::opengl::COpenGLScene::Ptr scene_;
  std::shared_ptr<GraphicsMesh> mesh_;
  mrpt::img::CImage image_;
  cv::Mat picture_;
};

OffscreenScene::OffscreenScene(int width_px, int height_px) {
  try {
    impl_ = std::make_unique<Impl>(width_px, height_px);
  } catch (const std::exception& e) {
    throw std::runtime_error(std::string("no off-screen OpenGL (EGL): ") + e.what());
  }
}

OffscreenScene::~OffscreenScene() = default;

void OffscreenScene::SetTextures(const std::vector<cv::Mat>& layers) {
  impl_->mesh().SetTextures(layers);
}

void OffscreenScene::SetMesh(const Mesh& mesh) {
  impl_->mesh().SetMesh(mesh);
}

void OffscreenScene::SortFrom(const Eigen::Vector3d& map_eye) {
  impl_->mesh().SortFrom(map_eye.cast<float>());
}

const cv::Mat& OffscreenScene::Render(const PinholeView& view) {
  return impl_->Render(view);
}

}  // namespace priamos::world
