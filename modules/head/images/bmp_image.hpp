#pragma once

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// Grey values of a BMP file of 8 (palette), 24 or 32 bits a pixel without compression; the fourth byte of 32
/// bits is not looked at. Refuses, with one sentence, other kinds, what is cut off and what exceeds `limits`.
Outcome<DecodedImage> DecodeBmp(FileBytes file, const ImageLimits& limits);

}  // namespace priamos::head
