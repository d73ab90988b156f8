#pragma once

#include <string>

#include "head/core/landmark/polyhedron.hpp"

namespace priamos::head {

/// Reads a free landmark model: ViSP's .cao, or TOML with `[[points]] at_m = [x, y, z]`, `[[faces]] points =
/// [0, 1, 2, ...]` and `[[lines]] points = [0, 1]`. Throws std::runtime_error with file:line and what was
/// expected.
Polyhedron LoadPolyhedron(const std::string& file);

}  // namespace priamos::head
