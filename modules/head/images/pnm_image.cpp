#include "head/images/pnm_image.hpp"

#include <fmt/format.h>

#include <cctype>
#include <optional>

namespace priamos::head {
namespace {

constexpr int kLargest = 65535;

/// Words of a header: numbers between blanks and comments.
class Words {
 public:
  explicit Words(FileBytes file) : file_(file), at_(2) {}

  /// The next number; nullopt for anything else, for the end and beyond `largest`.
  std::optional<int> Number(int largest) {
    SkipBlanks();
    if (at_ >= file_.size() || std::isdigit(file_[at_]) == 0) return std::nullopt;
    std::int64_t number = 0;
    for (; at_ < file_.size() && std::isdigit(file_[at_]) != 0; ++at_)
      if ((number = 10 * number + (file_[at_] - '0')) > largest) return std::nullopt;
    return static_cast<int>(number);
  }
  /// What follows the one blank that ends the header.
  FileBytes Rest() const { return file_.subspan(std::min(at_ + 1, file_.size())); }

 private:
  void SkipBlanks() {
    for (; at_ < file_.size(); ++at_) {
      if (file_[at_] == '#')
        while (at_ + 1 < file_.size() && file_[at_] != '\n') ++at_;
      else if (std::isspace(file_[at_]) == 0)
        return;
    }
  }
  FileBytes file_;
  std::size_t at_;
};

struct PnmHeader {
  int width = 0, height = 0, white = 0, channels = 1;
  bool is_text = false;

  std::size_t values() const { return std::size_t(width) * height * channels; }
  int bytes_per_value() const { return white > 255 ? 2 : 1; }
};

Refusal PnmDamage(const std::string& got) {
  return {fmt::format("expected a whole PGM or PPM image, got one {}; fetch it again", got)};
}

Outcome<PnmHeader> ReadHeader(FileBytes file, Words& words) {
  PnmHeader header;
  header.is_text = file[1] == '2' || file[1] == '3';
  header.channels = file[1] == '3' || file[1] == '6' ? 3 : 1;
  const auto width = words.Number(1 << 30), height = words.Number(1 << 30), white = words.Number(kLargest);
  if (!width || !height || !white || *white == 0)
    return PnmDamage(fmt::format("without width, height and largest value (1 to {})", kLargest));
  header.width = *width;
  header.height = *height;
  header.white = *white;
  return header;
}

/// The values as 16 bits; false if there are too few or one is too large.
template <class Next>
bool Fill(cv::Mat& samples, const PnmHeader& header, const Next& next) {
  const int values = header.width * header.channels;
  for (int v = 0; v < header.height; ++v) {
    auto* row = samples.ptr<std::uint16_t>(v);
    for (int i = 0; i < values; ++i) {
      const std::optional<int> value = next();
      if (!value || *value > header.white) return false;
      row[i] = static_cast<std::uint16_t>(*value);
    }
  }
  return true;
}

bool FillFromBytes(cv::Mat& samples, const PnmHeader& header, FileBytes data) {
  const int size = header.bytes_per_value();
  std::size_t at = 0;
  return Fill(samples, header, [&]() -> std::optional<int> {
    const int value = size == 1 ? data[at] : data[at] << 8 | data[at + 1];
    at += size;
    return value;
  });
}

}  // namespace

Outcome<DecodedImage> DecodePnm(FileBytes file, const ImageLimits& limits) {
  Words words(file);
  const auto header = ReadHeader(file, words);
  if (!header) return Refusal{header.reason()};
  if (const auto refusal = CheckImageSize(header->width, header->height, limits)) return *refusal;
  const FileBytes data = words.Rest();
  // Of a text, a value takes a digit and a blank.
  const std::size_t fewest =
      header->is_text ? 2 * header->values() - 1 : header->values() * header->bytes_per_value();
  if (data.size() < fewest)
    return PnmDamage(fmt::format("that is cut off: {} of at least {} bytes", data.size(), fewest));
  cv::Mat samples(header->height, header->width, CV_MAKETYPE(CV_16U, header->channels));
  const bool complete = header->is_text ? Fill(samples, *header, [&] { return words.Number(kLargest); })
                                        : FillFromBytes(samples, *header, data);
  if (!complete)
    return PnmDamage(fmt::format("that is damaged: expected values of 0 to {} throughout", header->white));
  if (header->white <= 255) samples.convertTo(samples, CV_8U);
  const auto grey = GreyOfSamples(samples);
  if (!grey) return Refusal{grey.reason()};
  return DecodedImage{*grey, header->white};
}

}  // namespace priamos::head
