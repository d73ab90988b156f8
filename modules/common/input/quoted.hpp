#pragma once

#include <string>
#include <string_view>

namespace priamos {

/// A text of others on one line of a terminal: control characters as `\n`, `\x1b`, `\u009b`; all else, UTF-8
/// too, as it is.
std::string Escaped(std::string_view text);

/// A text of at most 80 bytes as it is; of a longer one the beginning, `...` and how long it is.
std::string Shortened(std::string_view text);

/// A text for a sentence: shortened, escaped, in double quotes, in which a double quote is `\"` and a
/// backslash
/// `\\`.
std::string Quoted(std::string_view text);

}  // namespace priamos
