#pragma once

#include <string>

#include "head/core/bodies/triangle_mesh.hpp"

namespace priamos::head {

/// Reads the triangles of a Wavefront OBJ or STL file (text or binary) by Assimp, in its own units. Throws
/// ConfigError naming the file for one that is no regular file, is longer than 64 MB, cannot be understood,
/// or holds nothing.
TriangleMesh LoadMesh(const std::string& file);

}  // namespace priamos::head
