#include "world/core/render/graphics_context.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "world/core/render/graphics_mesh.hpp"

namespace priamos::world {
namespace {

/// Mesa keeps compiled shaders below the home folder and complains where there is none. Ours compile in no
/// time. Who has set the variable is left alone.
void KeepNoShaders() {
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

}  // namespace

GraphicsContext::GraphicsContext(int width_px, int height_px)
    : frame_buffer_(static_cast<unsigned>(width_px), static_cast<unsigned>(height_px)),
      program_(GraphicsMesh::CompileProgram()),
      width_px_(width_px),
      height_px_(height_px) {}

std::shared_ptr<GraphicsContext> GraphicsContext::Hold(int width_px, int height_px) {
  thread_local std::weak_ptr<GraphicsContext> living;
  if (auto context = living.lock()) {
    if (context->width_px() != width_px || context->height_px() != height_px) {
      throw std::logic_error("one picture size per thread");
    }
    return context;
  }
  KeepNoShaders();
  try {
    auto context = std::make_shared<GraphicsContext>(width_px, height_px);
    living = context;
    return context;
  } catch (const std::exception& e) {
    throw std::runtime_error(std::string("no off-screen OpenGL (apt install libegl1 libgl1-mesa-dri): ") +
                             e.what());
  }
}

}  // namespace priamos::world
