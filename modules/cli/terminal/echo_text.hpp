#pragma once

#include <string>
#include <vector>

#include "cli/terminal/field_path.hpp"

namespace priamos::cli {

/// How a message is printed: indented, or as JSON on one line.
enum class EchoForm { kForPeople, kOneLine };

/// A message as `priamos topic echo` prints it, without the end of the last line: its `fields`, all when
/// there are none. For people a message is indented and a single field stands alone.
std::string EchoText(const bus::Json& message, const std::vector<FieldPath>& fields, EchoForm form);

}  // namespace priamos::cli
