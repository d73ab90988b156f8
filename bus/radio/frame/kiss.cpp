#include "bus/radio/frame/kiss.hpp"

#include <utility>

namespace priamos::bus::radio {
namespace {

constexpr std::byte kMark{0xC0}, kEscape{0xDB}, kEscapedMark{0xDC}, kEscapedEscape{0xDD};
/// Data for the first radio of the port.
constexpr std::byte kData{0x00};

}  // namespace

std::vector<std::byte> EncodeKiss(std::span<const std::byte> packet) {
  std::vector<std::byte> out{kMark, kData};
  for (const std::byte byte : packet) {
    if (byte == kMark) {
      out.insert(out.end(), {kEscape, kEscapedMark});
    } else if (byte == kEscape) {
      out.insert(out.end(), {kEscape, kEscapedEscape});
    } else {
      out.push_back(byte);
    }
  }
  out.push_back(kMark);
  return out;
}

std::optional<std::vector<std::byte>> KissDecoder::Push(std::byte byte) {
  if (byte != kMark) {
    Add(byte);
    return std::nullopt;
  }
  std::vector<std::byte> bytes = std::exchange(bytes_, {});
  const bool whole = !std::exchange(bad_, false) && !std::exchange(escaped_, false);
  if (!whole || bytes.size() < 2 || bytes.front() != kData) return std::nullopt;
  bytes.erase(bytes.begin());
  return bytes;
}

void KissDecoder::Add(std::byte byte) {
  if (!escaped_ && byte == kEscape) {
    escaped_ = true;
    return;
  }
  if (std::exchange(escaped_, false)) {
    bad_ = bad_ || (byte != kEscapedMark && byte != kEscapedEscape);
    byte = byte == kEscapedMark ? kMark : kEscape;
  }
  bad_ = bad_ || bytes_.size() > longest_;
  if (!bad_) bytes_.push_back(byte);
}

}  // namespace priamos::bus::radio
