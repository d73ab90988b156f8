#pragma once

#include "head/images/decoded_image.hpp"

namespace priamos::head {

/// The tag "orientation" (1 to 8) of an EXIF block, which is laid out as a TIFF file; 1 (upright) where the
/// block has none or is damaged: it says nothing about the pixels then.
int ExifOrientation(FileBytes exif);

}  // namespace priamos::head
