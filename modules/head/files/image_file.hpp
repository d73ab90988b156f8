#pragma once

#include <string>

#include "common/frame_store.hpp"

namespace priamos::head {

/// An image file as grey values. Throws ConfigError for what is no image of at least 64 by 64 pixels.
GreyImage ReadImage(const std::string& path);

}  // namespace priamos::head
