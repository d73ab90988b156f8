#pragma once

#include <mrpt/opengl/CFBORender.h>
#include <mrpt/opengl/Shader.h>

#include <memory>

namespace priamos::world {

/// What the OpenGL of a thread needs once, however many scenes there are: an off-screen context, a frame
/// buffer, a compiled program. OpenGL's current context belongs to the thread, so this does too.
class GraphicsContext {
 public:
  /// The context of this thread; made if nobody holds one. All holders want one picture size, else
  /// std::logic_error. Throws std::runtime_error, with what to install, when there is no off-screen OpenGL.
  static std::shared_ptr<GraphicsContext> Hold(int width_px, int height_px);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  mrpt::opengl::CFBORender& frame_buffer() { return frame_buffer_; }
  const mrpt::opengl::Program::Ptr& program() const { return program_; }

  GraphicsContext(int width_px, int height_px);

 private:
  mrpt::opengl::CFBORender frame_buffer_;  // makes the context, so it is first to come and last to go
  mrpt::opengl::Program::Ptr program_;
  int width_px_, height_px_;
};

}  // namespace priamos::world
