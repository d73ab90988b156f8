#pragma once

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// Grey values of a PGM or PPM file, as text (P2, P3) or bytes (P5, P6). Refuses, with one sentence, what is
/// cut off, values above the largest that the header names, and what exceeds `limits`.
Outcome<DecodedImage> DecodePnm(FileBytes file, const ImageLimits& limits);

}  // namespace priamos::head
