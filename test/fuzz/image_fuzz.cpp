#include <cstdlib>

#include "head/images/image_decoder.hpp"

/// Image files of all kinds: an image within the limits, or a sentence.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const priamos::head::ImageLimits limits{1 << 20};
  const auto image = priamos::head::DecodeImage({data, size}, limits);
  if (!image) {
    if (!image.reason().starts_with("expected ")) std::abort();
    return 0;
  }
  const bool is_sound = !image->grey.empty() && image->grey.total() <= limits.most_pixels && image->white > 0;
  if (!is_sound) std::abort();
  return 0;
}
