#pragma once

#include <string>
#include <vector>

#include "head/core/bodies/polyhedron.hpp"

namespace priamos::head {

/// A free landmark model, and the files that it was read from: a .cao may load others.
struct BodyFile {
  Polyhedron body;
  std::vector<std::string> files;
};

/// Reads a free landmark model: ViSP's .cao, or TOML with `[[points]] at_m = [x, y, z]`, `[[faces]] points =
/// [0, 1, 2, ...]` and `[[lines]] points = [0, 1]`, or the flat faces of an OBJ or STL mesh
/// (BodyOfTriangles). Lengths of the file times `scale` are metres. Throws std::runtime_error with file:line
/// (of a mesh the file) and what was expected.
BodyFile LoadBody(const std::string& file, double scale = 1);

/// The body of LoadBody.
Polyhedron LoadPolyhedron(const std::string& file, double scale = 1);

}  // namespace priamos::head
