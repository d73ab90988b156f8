#include "world/core/render/offscreen_scene.hpp"

#include <mrpt/opengl/CCamera.h>
#include <mrpt/opengl/COpenGLScene.h>

#include "world/core/render/graphics_context.hpp"
#include "world/core/render/graphics_mesh.hpp"

namespace priamos::world {

namespace {

mrpt::opengl::CCamera ToCamera(const PinholeView& view, int width, int height) {
  mrpt::img::TCamera pinhole;
  pinhole.ncols = static_cast<std::uint32_t>(width);
  pinhole.nrows = static_cast<std::uint32_t>(height);
  pinhole.setIntrinsicParamsFromValues(view.focal_px.x(), view.focal_px.y(), view.centre_px.x(),
                                       view.centre_px.y());
  mrpt::opengl::CCamera camera;
  camera.set6DOFMode(true);
  camera.setProjectiveFromPinhole(pinhole);
  camera.setPose(mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(view.map_from_camera.matrix())));
  return camera;
}

}  // namespace

class OffscreenScene::Impl {
 public:
  Impl(int width, int height)
      : context_(GraphicsContext::Hold(width, height)),
        scene_(mrpt::opengl::COpenGLScene::Create()),
        mesh_(std::make_shared<GraphicsMesh>()) {
    scene_->insert(mesh_);
    auto viewport = scene_->getViewport();
    // Its own program only: the stock ones would be compiled for nothing.
    viewport->shaders()[GraphicsMesh::kShader] = context_->program();
    viewport->setViewportClipDistances(0.05F, 60.0F);
    viewport->setCustomBackgroundColor({0, 0, 0, 1});
  }

  GraphicsMesh& mesh() { return *mesh_; }

  const cv::Mat& Render(const PinholeView& view) {
    // MRPT skips objects whose representative point and box seem out of sight; a room around the camera is
    // not.
    const Eigen::Vector3f ahead = (view.map_from_camera * Eigen::Vector3d(0, 0, 1)).cast<float>();
    mesh_->setLocalRepresentativePoint({ahead.x(), ahead.y(), ahead.z()});
    auto& frame_buffer = context_->frame_buffer();
    frame_buffer.setCamera(*scene_, ToCamera(view, context_->width_px(), context_->height_px()));
    frame_buffer.render_RGB(*scene_, image_);
    picture_ = image_.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
    return picture_;
  }

 private:
  std::shared_ptr<GraphicsContext> context_;  // before all that lives in it
  mrpt::opengl::COpenGLScene::Ptr scene_;
  std::shared_ptr<GraphicsMesh> mesh_;
  mrpt::img::CImage image_;
  cv::Mat picture_;
};

OffscreenScene::OffscreenScene(int width_px, int height_px)
    : impl_(std::make_unique<Impl>(width_px, height_px)) {}

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

std::shared_ptr<void> HoldGraphics(int width_px, int height_px) {
  return GraphicsContext::Hold(width_px, height_px);
}

}  // namespace priamos::world
