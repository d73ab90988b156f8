#pragma once

#include <string>
#include <vector>

namespace priamos {

/// The source text of one .lcm file.
struct TypeText {
  std::string file;  ///< where the text came from, for error messages
  std::string text;
};

/// All of lcmtypes/, compiled in: a process needs no source tree to read its own messages' comments.
std::vector<TypeText> EmbeddedTypes();

}  // namespace priamos
