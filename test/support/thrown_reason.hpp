#pragma once

#include <stdexcept>
#include <string>

namespace priamos::support {

/// What the exception says that `action` ends with; empty if it ends well.
template <class Action>
std::string ThrownReason(const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace priamos::support
