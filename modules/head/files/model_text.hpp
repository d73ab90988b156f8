#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "common/outcome.hpp"

namespace priamos::head {

/// The extension in small letters with its dot: `.obj` of `Box.OBJ`; empty without one.
std::string ExtensionOf(const std::string& file);

/// All of a file of at most `most_mb` megabytes, or why it is not read. `what` it should be: `a mesh`.
Outcome<std::string> ReadText(const std::string& path, std::string_view what, std::size_t most_mb);

}  // namespace priamos::head
