#pragma once

#include <string>
#include <vector>

namespace priamos::head {

/// What the edge operator finds in photographs; no robot needed.
struct SeeOptions {
  std::vector<std::string> images;  ///< files OpenCV can read
  std::string folder = ".";         ///< NAME-edges.png for each image NAME is written here
  std::string json;                 ///< all segments with sub-pixel ends; empty: none
};

/// Draws the edge segments of each image and lists them. Throws std::runtime_error naming a file that cannot
/// be read, is too small, or cannot be written; then nothing has been written for that image.
void See(const SeeOptions& options);

}  // namespace priamos::head
