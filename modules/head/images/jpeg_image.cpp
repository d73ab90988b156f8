#include "head/images/jpeg_image.hpp"

#include <fmt/format.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>

// These need <cstdio> before them.
#include <jerror.h>
#include <jpeglib.h>

#include "head/images/exif_orientation.hpp"

namespace priamos::head {
namespace {

/// An image is stored in 1 to 10 scans; thousands of empty ones would keep a decoder busy for hours.
constexpr int kMostScans = 100;

/// How libjpeg is left, which knows no exceptions.
struct Errors {
  jpeg_error_mgr base;
  std::jmp_buf back;
  char reason[JMSG_LENGTH_MAX];
};

Errors& ErrorsOf(j_common_ptr jpeg) {
  return *reinterpret_cast<Errors*>(jpeg->err);
}

[[noreturn]] void Leave(j_common_ptr jpeg) {
  Errors& errors = ErrorsOf(jpeg);
  errors.base.format_message(jpeg, errors.reason);
  std::longjmp(errors.back, 1);
}

/// libjpeg goes on with made-up pixels after most warnings, so all are errors but those about side matters.
void LeaveIfDamaged(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  if (level < 0 && code != JWRN_ADOBE_XFORM && code != JWRN_JFIF_MAJOR && code != JWRN_BOGUS_ICC) Leave(jpeg);
}

void LeaveAfterManyScans(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
  Errors& errors = ErrorsOf(jpeg);
  std::snprintf(errors.reason, sizeof errors.reason, "more than %d scans", kMostScans);
  std::longjmp(errors.back, 1);
}

/// A decoder of libjpeg. Nothing with a destructor lives where `Leave` passes.
class JpegReader {
 public:
  explicit JpegReader(FileBytes file) : file_(file) {
    jpeg_.err = jpeg_std_error(&errors_.base);
    errors_.base.error_exit = Leave;
    errors_.base.emit_message = LeaveIfDamaged;
    errors_.base.output_message = [](j_common_ptr) {};
    progress_.progress_monitor = LeaveAfterManyScans;
  }
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  bool ReadHeader() {
    if (setjmp(errors_.back) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_.progress = &progress_;
    jpeg_mem_src(&jpeg_, file_.data(), file_.size());
    jpeg_save_markers(&jpeg_, JPEG_APP0 + 1, 0xFFFF);
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }
  /// All of the image up to its end mark, into `grey` of its size.
  bool ReadGrey(const cv::Mat& grey) {
    if (setjmp(errors_.back) != 0) return false;
    jpeg_.out_color_space = JCS_GRAYSCALE;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = const_cast<JSAMPROW>(grey.ptr<std::uint8_t>(static_cast<int>(jpeg_.output_scanline)));
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }
  /// Known between header and image.
  int orientation() const {
    constexpr char kExif[] = "Exif\0";  // and the zero that ends it
    for (auto* marker = jpeg_.marker_list; marker != nullptr; marker = marker->next)
      if (marker->data_length > sizeof kExif && std::memcmp(marker->data, kExif, sizeof kExif) == 0)
        return ExifOrientation({marker->data + sizeof kExif, marker->data_length - sizeof kExif});
    return 1;
  }
  const jpeg_decompress_struct& header() const { return jpeg_; }
  Refusal damage() const {
    return {
        fmt::format("expected a whole JPEG image, got one that is cut off, damaged or unusual "
                    "({}); fetch it again or save it as PNG",
                    errors_.reason)};
  }

 private:
  FileBytes file_;
  jpeg_decompress_struct jpeg_{};
  jpeg_progress_mgr progress_{};
  Errors errors_{};
};

}  // namespace

Outcome<DecodedImage> DecodeJpeg(FileBytes file, const ImageLimits& limits) {
  JpegReader reader(file);
  if (!reader.ReadHeader()) return reader.damage();
  const jpeg_decompress_struct& header = reader.header();
  if (const auto refusal = CheckImageSize(header.image_width, header.image_height, limits)) return *refusal;
  if (header.num_components != 1 && header.num_components != 3)
    return Refusal{
        fmt::format("expected grey values or colours (RGB), got {} colours of a print (CMYK); "
                    "save it as RGB",
                    header.num_components)};
  const int orientation = reader.orientation();
  cv::Mat grey(static_cast<int>(header.image_height), static_cast<int>(header.image_width), CV_8UC1);
  if (!reader.ReadGrey(grey)) return reader.damage();
  return DecodedImage{TurnUpright(grey, orientation), 255};
}

}  // namespace priamos::head
