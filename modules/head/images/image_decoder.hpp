#pragma once

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// Most bytes that are read of a file, whatever it is.
inline constexpr std::size_t kMostImageBytes = std::size_t{1} << 30;

/// What the first bytes of a file show it to be ("JPEG", "WebP"); nullptr for no image that is known. The
/// name of the file does not count.
const char* NameOfImageKind(FileBytes file);

/// Grey values of a file of the kinds JPEG, PNG, TIFF, PGM, PPM and BMP. Refuses everything else, what is cut
/// off or damaged, and what exceeds `limits`, with one sentence: what was expected, what it got, what to do.
/// Never an image of which only a part was read.
Outcome<DecodedImage> DecodeImage(FileBytes file, const ImageLimits& limits);

}  // namespace priamos::head
