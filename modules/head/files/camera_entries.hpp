#pragma once

#include <string>
#include <vector>

namespace priamos::head {

/// A value of a file that describes a camera, whatever its notation.
struct CameraEntry {
  std::string key;  ///< with the keys it lies in: "camera_matrix/data"; the root of XML is left out
  int line = 0;     ///< from 1; 0 where the notation tells none (JSON)
  std::vector<std::string> words;  ///< the scalar, or the elements of a list, however deep
};

/// Keys and values of a file, in its order.
using CameraEntries = std::vector<CameraEntry>;

}  // namespace priamos::head
