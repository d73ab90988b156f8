#pragma once

#include <string>
#include <string_view>

namespace priamos {

/// A text of others on one line of a terminal: control characters as `\n`, `\x1b`, `\u009b`; all else, UTF-8
/// too, as it is.
std::string Escaped(std::string_view text);

/// The same in double quotes, in which a double quote is `\"` and a backslash `\\`.
std::string Quoted(std::string_view text);

}  // namespace priamos
