#pragma once

#include <functional>
#include <string>

#include "common/outcome.hpp"
#include "head/core/bodies/polyhedron.hpp"

namespace priamos::head {

/// Reads ViSP's model format: `V1`, points, lines, faces of lines, faces of points, cylinders, circles, and
/// `load("other.cao")` before them. Cylinders and circles have no straight edges and are refused.
/// `read` gives the text of a file that is loaded, or a reason; `name` and what it loads appear in messages
/// as file:line. Loading in circles is refused.
Outcome<Polyhedron> ParseCao(const std::string& name, const std::string& text,
                             const std::function<Outcome<std::string>(const std::string& file)>& read);

}  // namespace priamos::head
