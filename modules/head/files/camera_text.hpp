#pragma once

#include <string_view>

#include "common/outcome.hpp"
#include "head/files/camera_entries.hpp"

namespace priamos::head {

/// Reads YAML as OpenCV and ROS write it (nested maps and lists; with or without %YAML and ---; of several
/// documents the first), XML (elements and their text; attributes are left out, the second of equal elements
/// is called "name#2") or JSON. Refuses anything else with "LINE: expected ..., got ...", or without a line.
Outcome<CameraEntries> ParseCameraText(std::string_view text);

}  // namespace priamos::head
