#include "bus/schema/text_codec.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace priamos::bus {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<std::int8_t, 256> MakeValues() {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}
constexpr std::array<std::int8_t, 256> kValues = MakeValues();

/// What the first byte of a UTF-8 sequence determines.
struct SequenceForm {
  int size;             ///< bytes of the sequence; 0: no sequence begins with this byte
  std::uint32_t least;  ///< least code point that needs so many bytes
  std::uint32_t bits;   ///< the code point's bits in the first byte
};

SequenceForm FormOf(unsigned char lead) {
  if (lead < 0x80) return {.size = 1, .least = 0, .bits = lead};
  if ((lead & 0xe0) == 0xc0) return {.size = 2, .least = 0x80, .bits = lead & 0x1fU};
  if ((lead & 0xf0) == 0xe0) return {.size = 3, .least = 0x800, .bits = lead & 0x0fU};
  if ((lead & 0xf8) == 0xf0) return {.size = 4, .least = 0x10000, .bits = lead & 0x07U};
  return {.size = 0, .least = 0, .bits = 0};
}

/// Bytes of the well-formed sequence that `text` begins with; 0 when it begins with none.
std::size_t SequenceSize(std::string_view text) {
  const SequenceForm form = FormOf(static_cast<unsigned char>(text.front()));
  if (form.size == 0 || text.size() < static_cast<std::size_t>(form.size)) return 0;
  std::uint32_t code = form.bits;
  for (int i = 1; i < form.size; ++i) {
    const auto c = static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
    if ((c & 0xc0) != 0x80) return 0;
    code = code << 6 | (c & 0x3fU);
  }
  if (code < form.least || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return 0;
  return static_cast<std::size_t>(form.size);
}

std::string Latin1AsUtf8(unsigned char c) {
  if (c < 0xa0) return "\xEF\xBF\xBD";
  return {static_cast<char>(0xc0 | c >> 6), static_cast<char>(0x80 | (c & 0x3f))};
}

}  // namespace

bool IsUtf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t size = SequenceSize(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

std::string Utf8Of(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = SequenceSize(text);
    result += size > 0 ? text.substr(0, size) : Latin1AsUtf8(static_cast<unsigned char>(text.front()));
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

std::string ToBase64(std::span<const std::byte> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < n ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::optional<std::vector<std::byte>> FromBase64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t i = 0; i < text.size(); i += 4) {
    const std::string_view group = text.substr(i, 4);
    std::size_t digits = 4;
    if (i + 4 == text.size())
      digits -= static_cast<std::size_t>(group.ends_with("==") ? 2 : group.ends_with('='));
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const int digit = k < digits ? kValues[static_cast<unsigned char>(group[k])] : 0;
      if (digit < 0) return std::nullopt;
      value = value << 6 | static_cast<std::uint32_t>(digit);
    }
    for (std::size_t k = 0; k + 1 < digits; ++k)
      bytes.push_back(static_cast<std::byte>(value >> (16 - 8 * k) & 255));
  }
  return bytes;
}

}  // namespace priamos::bus
