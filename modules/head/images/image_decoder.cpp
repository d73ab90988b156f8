#include "head/images/image_decoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "head/images/bmp_image.hpp"
#include "head/images/jpeg_image.hpp"
#include "head/images/png_image.hpp"
#include "head/images/pnm_image.hpp"
#include "head/images/tiff_image.hpp"

namespace priamos::head {
namespace {

using std::string_view_literals::operator""sv;

using Decoder = Outcome<DecodedImage> (*)(FileBytes, const ImageLimits&);

struct Kind {
  std::string_view magic;
  std::size_t at;  ///< where the magic stands
  const char* name;
  Decoder decoder;  ///< nullptr: known by name only
};

constexpr Kind kKinds[]{
    {"\xff\xd8\xff"sv, 0, "JPEG", DecodeJpeg},
    {"\x89PNG\r\n\x1a\n"sv, 0, "PNG", DecodePng},
    {"II*\0"sv, 0, "TIFF", DecodeTiff},
    {"MM\0*"sv, 0, "TIFF", DecodeTiff},
    {"II+\0"sv, 0, "TIFF", DecodeTiff},
    {"MM\0+"sv, 0, "TIFF", DecodeTiff},
    {"P2"sv, 0, "PGM", DecodePnm},
    {"P5"sv, 0, "PGM", DecodePnm},
    {"P3"sv, 0, "PPM", DecodePnm},
    {"P6"sv, 0, "PPM", DecodePnm},
    {"BM"sv, 0, "BMP", DecodeBmp},
    {"P1\n"sv, 0, "PBM", nullptr},
    {"P4\n"sv, 0, "PBM", nullptr},
    {"P7\n"sv, 0, "PAM", nullptr},
    {"Pf\n"sv, 0, "PFM", nullptr},
    {"PF\n"sv, 0, "PFM", nullptr},
    {"GIF8"sv, 0, "GIF", nullptr},
    {"WEBP"sv, 8, "WebP", nullptr},
    {"ftyp"sv, 4, "HEIF, AVIF or a film", nullptr},
    {"jP  "sv, 4, "JPEG 2000", nullptr},
    {"\x76\x2f\x31\x01"sv, 0, "OpenEXR", nullptr},
    {"#?R"sv, 0, "Radiance HDR", nullptr},
    {"%PDF"sv, 0, "PDF", nullptr},
};

const Kind* KindOf(FileBytes file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const auto* kind = std::ranges::find_if(
      kKinds, [&](const Kind& k) { return text.size() >= k.at && text.substr(k.at).starts_with(k.magic); });
  return kind == std::end(kKinds) ? nullptr : kind;
}

}  // namespace

const char* NameOfImageKind(FileBytes file) {
  const Kind* kind = KindOf(file);
  return kind != nullptr ? kind->name : nullptr;
}

Outcome<DecodedImage> DecodeImage(FileBytes file, const ImageLimits& limits) {
  constexpr const char* kExpected = "expected an image (PNG, JPEG, TIFF, PGM, PPM or BMP)";
  const Kind* kind = KindOf(file);
  if (file.empty()) return Refusal{fmt::format("{}, got an empty file", kExpected)};
  if (kind == nullptr) return Refusal{fmt::format("{}, got none", kExpected)};
  if (kind->decoder == nullptr)
    return Refusal{fmt::format("{}, got {}; save it as PNG", kExpected, kind->name)};
  return kind->decoder(file, limits);
}

}  // namespace priamos::head
