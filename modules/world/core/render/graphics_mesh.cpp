#include "world/core/render/graphics_mesh.hpp"

#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <GL/glext.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>

IMPLEMENTS_SERIALIZABLE(GraphicsMesh, CRenderizable, priamos::world)

namespace priamos::world {

namespace {

constexpr const char* kVertexShader = R"(#version 330 core
in vec3 position;
in vec3 uv;
in vec3 light_retro_laser;
uniform mat4 pmv_matrix;
out vec3 fragment_uv;
out vec3 fragment_light;
void main() {
  fragment_uv = uv;
  fragment_light = light_retro_laser;
  gl_Position = pmv_matrix * vec4(position, 1.0);
}
)";

constexpr const char* kFragmentShader = R"(#version 330 core
uniform sampler2DArray albedo;
in vec3 fragment_uv;
in vec3 fragment_light;
out vec4 color;
void main() {
  float lit = texture(albedo, fragment_uv).r * fragment_light.x;
  color = vec4(lit, fragment_light.yz, 1.0);
}
)";

/// OpenGL takes an offset in a buffer as a pointer.
const void* Offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

}  // namespace

mrpt::opengl::Program::Ptr GraphicsMesh::CompileProgram() {
  std::vector<mrpt::opengl::Shader> shaders(2);
  std::string error;
  auto program = std::make_shared<mrpt::opengl::Program>();
  if (!shaders[0].compile(GL_VERTEX_SHADER, kVertexShader, error) ||
      !shaders[1].compile(GL_FRAGMENT_SHADER, kFragmentShader, error) ||
      !program->linkProgram(shaders, error)) {
    throw std::runtime_error("shader: " + error);
  }
  program->declareUniform("pmv_matrix");
  program->declareUniform("albedo");
  for (const char* attribute : {"position", "uv", "light_retro_laser"}) program->declareAttribute(attribute);
  return program;
}

GraphicsMesh::~GraphicsMesh() {
  glDeleteTextures(1, &textures_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
  glDeleteVertexArrays(1, &array_);
}

void GraphicsMesh::SetTextures(const std::vector<cv::Mat>& layers) {
  const int side = layers.at(0).cols;
  if (textures_ == 0) glGenTextures(1, &textures_);
  glBindTexture(GL_TEXTURE_2D_ARRAY, textures_);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_R8, side, side, static_cast<GLsizei>(layers.size()), 0, GL_RED,
               GL_UNSIGNED_BYTE, nullptr);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(i), side, side, 1, GL_RED,
                    GL_UNSIGNED_BYTE, layers[i].data);
  }
  glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

void GraphicsMesh::SetMesh(const Mesh& mesh) {
  if (array_ == 0) {
    glGenVertexArrays(1, &array_);
    glGenBuffers(1, &vertices_);
    glGenBuffers(1, &indices_);
  }
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.size() * sizeof(mesh[0])), mesh.data(),
               GL_STATIC_DRAW);
  triangles_ = mesh.size();
  centres_.clear();
  for (const auto& t : mesh) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (const MeshVertex& v : t) sum += Eigen::Vector3f(v.x, v.y, v.z);
    centres_.push_back(sum / 3);
  }
  SortFrom(Eigen::Vector3f::Zero());
}

void GraphicsMesh::SortFrom(const Eigen::Vector3f& eye) {
  std::vector<std::uint32_t> order(triangles_);
  std::vector<float> distance(triangles_);
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = 0; i < triangles_; ++i) distance[i] = (centres_[i] - eye).squaredNorm();
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return distance[a] < distance[b]; });
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * triangles_);
  for (const std::uint32_t t : order) indices.insert(indices.end(), {3 * t, 3 * t + 1, 3 * t + 2});
  glBindVertexArray(array_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(indices[0])),
               indices.data(), GL_STREAM_DRAW);
}

void GraphicsMesh::render(const RenderContext& context) const {
  const mrpt::opengl::Program& program = *context.shader;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, textures_);
  glUniform1i(program.uniformId("albedo"), 0);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  const auto attribute = [&](const char* name, int size, std::size_t offset) {
    const auto id = static_cast<GLuint>(program.attributeId(name));
    glEnableVertexAttribArray(id);
    glVertexAttribPointer(id, size, GL_FLOAT, GL_FALSE, sizeof(MeshVertex), Offset(offset));
  };
  attribute("position", 3, offsetof(MeshVertex, x));
  attribute("uv", 3, offsetof(MeshVertex, u));
  attribute("light_retro_laser", 3, offsetof(MeshVertex, light));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  glDisable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles_), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_CULL_FACE);
}

mrpt::math::TBoundingBoxf GraphicsMesh::internalBoundingBoxLocal() const {
  return mrpt::math::TBoundingBoxf::PlusMinusInfinity();
}

std::uint8_t GraphicsMesh::serializeGetVersion() const {
  return 0;
}

void GraphicsMesh::serializeTo(mrpt::serialization::CArchive&) const {
  throw std::logic_error("a mesh in graphics memory cannot be saved");
}

void GraphicsMesh::serializeFrom(mrpt::serialization::CArchive&, std::uint8_t) {
  throw std::logic_error("a mesh in graphics memory cannot be loaded");
}

}  // namespace priamos::world
