#pragma once

#include <string>
#include <string_view>

namespace priamos {

/// The text of a file of secrets. `what` it should be, for the sentence: `tokens`, `a private key`. Throws
/// std::runtime_error when it is no regular file, longer than 64 kB, or others than its owner can read it.
std::string ReadPrivateFile(const std::string& file, std::string_view what);

/// The same for a file that everybody may read.
std::string ReadPublicFile(const std::string& file, std::string_view what);

}  // namespace priamos
