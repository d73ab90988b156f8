#include "head/files/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/config.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;

/// The file's content: Assimp gets bytes and no name, so a mesh cannot make it read other files.
std::string BytesOf(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw ConfigError(fmt::format("{}: expected a file, got none", file));
  const auto size = std::filesystem::file_size(file, error);
  if (size == 0) throw ConfigError(fmt::format("{}: expected triangles, got an empty file", file));
  if (error || size > kMostBytes)
    throw ConfigError(fmt::format("{}: expected a mesh of at most {} MB, got {} bytes", file,
                                  kMostBytes >> 20, error ? 0 : size));
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in || in.gcount() != static_cast<std::streamsize>(size))
    throw ConfigError(fmt::format("{}: cannot be read: {}", file, std::strerror(errno)));
  return bytes;
}

void Append(const aiMesh& part, double scale, TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.points.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.points.emplace_back(scale * v.x, scale * v.y, scale * v.z);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines
    const unsigned* at = face.mIndices;
    mesh.triangles.push_back(
        {first + static_cast<int>(at[0]), first + static_cast<int>(at[1]), first + static_cast<int>(at[2])});
  }
}

}  // namespace

TriangleMesh LoadMesh(const std::string& file, double scale) {
  const std::string bytes = BytesOf(file);
  const std::string kind = std::filesystem::path(file).extension().string().substr(1);
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, kind.c_str());
  if (!scene)
    throw ConfigError(
        fmt::format("{}: expected a mesh as .{} holds it: {}", file, kind, importer.GetErrorString()));
  TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) Append(*scene->mMeshes[i], scale, mesh);
  if (mesh.triangles.empty()) throw ConfigError(fmt::format("{}: expected triangles, got none", file));
  return mesh;
}

}  // namespace priamos::head
