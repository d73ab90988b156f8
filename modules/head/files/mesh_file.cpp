#include "head/files/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <optional>
#include <string_view>

#include "common/config.hpp"
#include "head/files/mesh_text.hpp"
#include "head/files/model_text.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kMostMesh_MB = 64;

/// The file's content: Assimp gets bytes and no name, so a mesh cannot make it read other files.
std::string MeshBytes(const std::string& path) {
  auto bytes = ReadText(path, "a mesh", kMostMesh_MB);
  if (!bytes) throw ConfigError(bytes.reason());
  if (bytes->empty()) throw ConfigError(fmt::format("{}: expected triangles, got an empty file", path));
  return std::move(*bytes);
}

/// Wavefront text as Assimp understands it: without a byte order mark, without comments behind a value, and
/// with lines that go on in the next one as one.
std::string PlainObj(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::string plain;
  plain.reserve(text.size());
  bool in_comment = false;
  for (const char c : text) {
    if (c == '#') in_comment = true;
    if (c == '\n') in_comment = false;
    if (in_comment) continue;
    const bool goes_on = c == '\n' && plain.ends_with('\\');
    if (goes_on) plain.back() = ' ';
    plain += goes_on ? ' ' : c;
  }
  return plain;
}

/// The text form of .stl; the binary one may begin with the same word.
bool IsTextOfStl(std::string_view bytes) {
  return bytes.starts_with("solid") && bytes.find("endsolid") != std::string_view::npos;
}

/// Throws ConfigError "FILE:LINE: KEY: what" for a text that holds no mesh.
void CheckText(const std::string& file, const std::string& extension, std::string_view bytes) {
  std::optional<std::string> wrong;
  if (extension == ".obj") wrong = WrongLineOfObj(bytes);
  if (extension == ".stl" && IsTextOfStl(bytes)) wrong = WrongLineOfStl(bytes);
  if (wrong) throw ConfigError(fmt::format("{}:{}", file, *wrong));
}

void Append(const aiMesh& part, TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.points.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.points.emplace_back(v.x, v.y, v.z);
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

TriangleMesh LoadMesh(const std::string& file) {
  std::string bytes = MeshBytes(file);
  const std::string extension = ExtensionOf(file);
  if (extension == ".obj") bytes = PlainObj(bytes);
  CheckText(file, extension, bytes);
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, extension.c_str() + 1);
  if (!scene) throw ConfigError(fmt::format("{}: expected a whole mesh as {} holds it", file, extension));
  TriangleMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) Append(*scene->mMeshes[i], mesh);
  if (mesh.triangles.empty()) throw ConfigError(fmt::format("{}: expected triangles, got none", file));
  return mesh;
}

}  // namespace priamos::head
