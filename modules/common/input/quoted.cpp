#include "common/input/quoted.hpp"

#include <fmt/format.h>

#include "common/input/utf8.hpp"

namespace priamos {
namespace {

/// U+0080 to U+009F, which terminals may obey: two bytes, of which this is the first.
constexpr unsigned char kC1Lead = 0xC2;
/// Bytes of a text of others that a sentence shows.
constexpr std::size_t kMostShown = 80;

bool IsC1At(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]) == kC1Lead && i + 1 < text.size() &&
         static_cast<unsigned char>(text[i + 1]) >= 0x80 && static_cast<unsigned char>(text[i + 1]) < 0xA0;
}

std::string EscapedCharacter(char c) {
  if (c == '\n') return "\\n";
  if (c == '\r') return "\\r";
  if (c == '\t') return "\\t";
  return IsControl(c) ? fmt::format("\\x{:02x}", static_cast<unsigned char>(c)) : std::string(1, c);
}

}  // namespace

std::string Escaped(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (IsC1At(text, i))
      escaped += fmt::format("\\u{:04x}", static_cast<unsigned char>(text[++i]));
    else
      escaped += EscapedCharacter(text[i]);
  }
  return escaped;
}

std::string Shortened(std::string_view text) {
  if (text.size() <= kMostShown) return std::string(text);
  return fmt::format("{}... ({} bytes)", CutUtf8(text, kMostShown), text.size());
}

std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : Shortened(text)) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return Escaped(quoted) + '"';
}

}  // namespace priamos
