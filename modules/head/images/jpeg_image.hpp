#pragma once

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// Grey values of a JPEG file, upright as its EXIF says. Refuses, with one sentence, what is cut off or
/// damaged as far as the stream shows it (JPEG has no checksum), colours of a print (CMYK) and what exceeds
/// `limits`.
Outcome<DecodedImage> DecodeJpeg(FileBytes file, const ImageLimits& limits);

}  // namespace priamos::head
