#pragma once

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// Grey values of a PNG file of any colour type and depth, upright as its EXIF says. Refuses, with one
/// sentence, what is cut off or damaged (every part has a checksum), what is transparent and what exceeds
/// `limits`.
Outcome<DecodedImage> DecodePng(FileBytes file, const ImageLimits& limits);

}  // namespace priamos::head
