#include "head/images/png_image.hpp"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <cstdio>
#include <cstring>
#include <vector>

#include "head/images/exif_orientation.hpp"

namespace priamos::head {
namespace {

/// Where libpng is in the file, and how it is left: it knows no exceptions.
struct Stream {
  FileBytes rest;
  char reason[128] = "";
};

void Read(png_structp png, png_bytep to, std::size_t size) {
  Stream& stream = *static_cast<Stream*>(png_get_io_ptr(png));
  if (size > stream.rest.size()) png_error(png, "it ends early");
  std::memcpy(to, stream.rest.data(), size);
  stream.rest = stream.rest.subspan(size);
}

[[noreturn]] void Leave(png_structp png, png_const_charp reason) {
  Stream& stream = *static_cast<Stream*>(png_get_error_ptr(png));
  std::snprintf(stream.reason, sizeof stream.reason, "%s", reason);
  png_longjmp(png, 1);
}

void BeSilent(png_structp, png_const_charp) {}

/// A decoder of libpng. Nothing with a destructor lives where `Leave` passes.
class PngReader {
 public:
  explicit PngReader(FileBytes file) : stream_{file} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream_, Leave, BeSilent);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) throw std::bad_alloc();
    png_set_read_fn(png_, &stream_, Read);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool ReadHeader() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, 0x7fffffff, 0x7fffffff);  // the size is refused in a sentence of ours
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(png_, info_);
    return true;
  }
  /// Makes 1 to 4 samples of 8 or 16 bits a pixel of whatever the file holds; returns OpenCV's type.
  bool Expand(int& type) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_expand(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    type = CV_MAKETYPE(png_get_bit_depth(png_, info_) == 16 ? CV_16U : CV_8U, png_get_channels(png_, info_));
    return true;
  }
  /// All of the image up to its end mark.
  bool ReadRows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows);
    png_read_end(png_, info_);
    return true;
  }
  /// As of the header; after ReadRows also of what stands behind the image.
  int orientation() const {
    png_uint_32 size = 0;
    png_bytep exif = nullptr;
    if (png_get_eXIf_1(png_, info_, &size, &exif) == 0) return 1;
    return ExifOrientation({exif, size});
  }
  std::int64_t width() const { return png_get_image_width(png_, info_); }
  std::int64_t height() const { return png_get_image_height(png_, info_); }
  Refusal damage() const {
    return {fmt::format("expected a whole PNG image, got one that is cut off or damaged ({}); fetch it again",
                        stream_.reason)};
  }

 private:
  Stream stream_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

Outcome<DecodedImage> DecodePng(FileBytes file, const ImageLimits& limits) {
  PngReader reader(file);
  if (!reader.ReadHeader()) return reader.damage();
  if (const auto refusal = CheckImageSize(reader.width(), reader.height(), limits)) return *refusal;
  int type = CV_8UC1;
  if (!reader.Expand(type)) return reader.damage();
  cv::Mat samples(static_cast<int>(reader.height()), static_cast<int>(reader.width()), type);
  std::vector<png_bytep> rows(samples.rows);
  for (int v = 0; v < samples.rows; ++v) rows[v] = samples.ptr(v);
  if (!reader.ReadRows(rows.data())) return reader.damage();
  const auto grey = GreyOfSamples(samples);
  if (!grey) return Refusal{grey.reason()};
  return DecodedImage{TurnUpright(*grey, reader.orientation()), samples.depth() == CV_16U ? 65535 : 255};
}

}  // namespace priamos::head
