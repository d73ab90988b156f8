#pragma once

#include <mrpt/opengl/CRenderizable.h>
#include <mrpt/opengl/Shader.h>

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "world/core/render/mesh.hpp"

namespace priamos::world {

/// A Mesh as an object of an MRPT scene, with textures in mip-map levels and light computed beforehand. Lives
/// and dies while its OpenGL context is current.
class GraphicsMesh : public mrpt::opengl::CRenderizable {
  DEFINE_SERIALIZABLE(GraphicsMesh, priamos::world)

 public:
  static constexpr mrpt::opengl::shader_id_t kShader = 100;
  static mrpt::opengl::Program::Ptr CompileProgram();

  GraphicsMesh() = default;
  ~GraphicsMesh() override;

  void SetTextures(const std::vector<cv::Mat>& layers);
  void SetMesh(const Mesh& mesh);
  void SortFrom(const Eigen::Vector3f& eye);

  mrpt::opengl::shader_list_t requiredShaders() const override { return {kShader}; }
  void render(const RenderContext& context) const override;
  void renderUpdateBuffers() const override {}
  mrpt::math::TBoundingBoxf internalBoundingBoxLocal() const override;
  void freeOpenGLResources() override {}

 private:
  unsigned textures_ = 0, vertices_ = 0, indices_ = 0, array_ = 0;
  std::vector<Eigen::Vector3f> centres_;
  std::size_t triangles_ = 0;
};

}  // namespace priamos::world
