#pragma once

#include <string>

#include "common/web/web_request.hpp"

namespace priamos {

/// Whether nobody but this host reaches a server on `address`.
bool IsLoopback(const std::string& address);

/// Who may connect to a server on `address`: anybody on loopback without a token file, else who knows a token
/// of `file`. Its lines are `driver TOKEN [NAME]` or `viewer TOKEN [NAME]`, tokens of 16 to 64 letters,
/// digits,
/// - and _, names of at most 24 such; empty lines and comments with #. Throws std::runtime_error, `file:line:
/// expected ...`, when it says something else or others than its owner can read it, or when there is none and
/// `address` is not of the loopback.
WebAccess LoadAccess(const std::string& address, const std::string& file);

}  // namespace priamos
