#include "bus/radio/frame/cobs.hpp"

namespace priamos::bus::radio {

std::vector<std::byte> CobsEncode(std::span<const std::byte> content) {
  std::vector<std::byte> out;
  out.reserve(content.size() + content.size() / 254 + 1);
  out.push_back(std::byte{0});
  std::size_t code_at = 0;
  const auto close_block = [&] {
    out[code_at] = static_cast<std::byte>(out.size() - code_at);
    code_at = out.size();
    out.push_back(std::byte{0});
  };
  for (std::size_t i = 0; i < content.size(); ++i) {
    if (content[i] == std::byte{0}) {
      close_block();
      continue;
    }
    out.push_back(content[i]);
    // A full block stands for no zero; at the very end it needs no successor.
    if (out.size() - code_at == 255 && i + 1 < content.size()) close_block();
  }
  out[code_at] = static_cast<std::byte>(out.size() - code_at);
  return out;
}

std::optional<std::vector<std::byte>> CobsDecode(std::span<const std::byte> encoded) {
  std::vector<std::byte> content;
  content.reserve(encoded.size());
  std::size_t at = 0;
  while (at < encoded.size()) {
    const auto code = std::to_integer<std::size_t>(encoded[at]);
    if (code == 0 || at + code > encoded.size()) return std::nullopt;
    for (std::size_t i = at + 1; i < at + code; ++i) {
      if (encoded[i] == std::byte{0}) return std::nullopt;
      content.push_back(encoded[i]);
    }
    at += code;
    if (code < 255 && at < encoded.size()) content.push_back(std::byte{0});
  }
  return content;
}

FrameSplitter::Event FrameSplitter::Push(std::byte byte) {
  if (complete_) frame_.clear();
  complete_ = false;
  if (byte != std::byte{0}) {
    overflow_ = overflow_ || frame_.size() == max_bytes_;
    if (!overflow_) frame_.push_back(byte);
    return Event::kNone;
  }
  complete_ = true;
  if (overflow_) {
    overflow_ = false;
    return Event::kOversize;
  }
  return frame_.empty() ? Event::kNone : Event::kFrame;  // two delimiters in a row are idle line
}

}  // namespace priamos::bus::radio
