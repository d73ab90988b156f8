#include "cli/supervise/console_piece.hpp"

#include <algorithm>
#include <fstream>

#include "bus/schema/text_codec.hpp"
#include "common/input/utf8.hpp"

namespace priamos::cli {
namespace {

std::string Shown(std::string_view text) {
  std::string shown(text);
  for (char& c : shown)
    if (c != '\n' && IsControl(c)) c = '?';
  if (!bus::IsUtf8(shown))
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) > 0x7e; }, '?');
  return shown;
}

}  // namespace

ConsolePiece LastLines(std::string_view window, std::int64_t begin, std::size_t most) {
  std::size_t from = window.size() > most ? window.size() - most : 0;
  // A line that began before is left out, unless nothing would be left.
  if (from > 0 && window[from - 1] != '\n') {
    const std::size_t line = window.find('\n', from);
    if (line != std::string_view::npos && line + 1 < window.size()) from = line + 1;
  }
  while (from < window.size() && IsUtf8Continuation(window[from])) ++from;
  return {begin + static_cast<std::int64_t>(from), Shown(window.substr(from))};
}

std::optional<ConsolePiece> ReadConsolePiece(const std::string& file, std::int64_t end, std::size_t most) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return std::nullopt;
  const std::int64_t size = in.tellg();
  const std::int64_t until = end <= 0 || end > size ? size : end;
  // One byte more than is told shows whether a line begins there.
  const std::int64_t begin = std::max<std::int64_t>(0, until - static_cast<std::int64_t>(most) - 1);
  std::string window(static_cast<std::size_t>(until - begin), '\0');
  in.seekg(begin);
  in.read(window.data(), static_cast<std::streamsize>(window.size()));
  if (!in) return std::nullopt;
  return LastLines(window, begin, most);
}

}  // namespace priamos::cli
