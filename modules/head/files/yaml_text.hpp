#pragma once

#include <string_view>

#include "common/outcome.hpp"
#include "head/files/camera_entries.hpp"

namespace priamos::head {

/// The YAML of ParseCameraText. Refuses with "LINE: expected ..., got ...".
Outcome<CameraEntries> ParseYaml(std::string_view text);

}  // namespace priamos::head
