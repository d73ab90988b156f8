#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace priamos {

/// A class, struct, union or enum that a header defines and that who includes it can name.
struct PublicType {
  std::string name;
  int line = 0;             ///< of its definition, `template <...>` included, from 1
  bool documented = false;  ///< a comment `///` ends on the line before it
};

/// The public types of a header, in its order. Left out are those in namespaces without a name or named
/// `detail`, in private and protected parts of classes, and in bodies of functions. It reads what
/// clang-format leaves, and is no parser of C++: macros and raw strings with braces would confuse it.
std::vector<PublicType> PublicTypesOf(std::string_view header);

}  // namespace priamos
