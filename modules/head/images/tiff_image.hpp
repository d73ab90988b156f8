#pragma once

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// Grey values of the first image of a TIFF file: grey, palette or red-green-blue, whole values of 8 to 16
/// bits, without compression or with LZW, Deflate or PackBits; upright as its tag says. Refuses, with one
/// sentence, other kinds, what is cut off or damaged as far as the stream shows it, what is transparent and
/// what exceeds `limits`.
Outcome<DecodedImage> DecodeTiff(FileBytes file, const ImageLimits& limits);

}  // namespace priamos::head
