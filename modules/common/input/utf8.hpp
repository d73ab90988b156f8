#pragma once

#include <cstddef>
#include <string_view>

namespace priamos {

/// Whether a byte is a control character of ASCII: C0 with NUL and line breaks, or DEL.
constexpr bool IsControl(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

/// Whether a byte of UTF-8 goes on with a character that began before it.
constexpr bool IsUtf8Continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80;
}

/// The beginning of `text` of at most `bytes` bytes that does not end within a character. Where none begins
/// within the last four bytes, it is no UTF-8, and is cut at `bytes`.
constexpr std::string_view CutUtf8(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  for (std::size_t end = bytes; end > 0 && bytes - end < 4; --end)
    if (!IsUtf8Continuation(text[end])) return text.substr(0, end);
  return text.substr(0, bytes);
}

}  // namespace priamos
