#pragma once

#include <filesystem>

namespace priamos::support {

/// Writes the files that READMEs speak of into `folder`: logs of a run, points and photographs for
/// calibrations, pictures of a door for two cameras and of a body for one. Photographs of chessboards and
/// grids are Debian's (opencv-doc, visp-images-data) and left out where these are not installed.
void WriteReadmeMaterial(const std::filesystem::path& folder);

}  // namespace priamos::support
