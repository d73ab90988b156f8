#pragma once

#include <cstdint>
#include <vector>

#include "common/time.hpp"

namespace priamos::head {

/// A picture in the frame store.
struct FrameNotice {
  Time exposure;
  std::int32_t frame_id = 0;
  int camera = 0;  ///< 0 left, 1 right, 2 third
  int slot = 0;
  int width = 0, height = 0;
};

/// The pictures of one exposure, by camera: two for a look, three for a calibration.
using Frames = std::vector<FrameNotice>;

}  // namespace priamos::head
