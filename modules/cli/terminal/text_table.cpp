#include "cli/terminal/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/input/utf8.hpp"

namespace priamos::cli {
namespace {

constexpr int kGap = 2;

std::string Padded(const std::string& text, int width, bool is_text) {
  const std::string blanks(static_cast<std::size_t>(std::max(0, width - Characters(text))), ' ');
  return is_text ? text + blanks : blanks + text;
}

/// Where the character with that number, from 0, begins.
std::size_t ByteOf(const std::string& text, int character) {
  std::size_t at = 0;
  for (int n = 0; at < text.size(); ++at)
    if (!IsUtf8Continuation(text[at]) && n++ == character) break;
  return at;
}

}  // namespace

int TextTable::WidthOf(std::size_t column) const {
  int width = Characters(columns_[column].title);
  for (const auto& row : rows_) width = std::max(width, Characters(row.at(column)));
  return width;
}

std::vector<std::size_t> TextTable::Chosen(int width) const {
  std::vector<std::size_t> chosen;
  int needed = -kGap;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    chosen.push_back(i);
    needed += WidthOf(i) + kGap;
  }
  while (needed > width && chosen.size() > 1) {
    const auto least = std::min_element(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
      return columns_[a].worth < columns_[b].worth;
    });
    needed -= WidthOf(*least) + kGap;
    chosen.erase(least);
  }
  return chosen;
}

std::string TextTable::Line(const std::vector<std::string>& cells, const std::vector<std::size_t>& chosen,
                            int width) const {
  std::string line;
  for (const std::size_t i : chosen) {
    if (!line.empty()) line.append(kGap, ' ');
    line += Padded(cells.at(i), WidthOf(i), columns_[i].is_text);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return Clipped(line, width) + "\n";
}

std::string TextTable::Render(ScreenSize size) const {
  const auto chosen = Chosen(size.columns);
  std::vector<std::string> titles;
  for (const Column& column : columns_) titles.push_back(column.title);
  std::string text = Line(titles, chosen, size.columns);
  const auto room = static_cast<std::size_t>(std::max(0, size.rows - 1));
  const std::size_t shown = rows_.size() <= room ? rows_.size() : std::max<std::size_t>(room, 1) - 1;
  for (std::size_t i = 0; i < shown; ++i) text += Line(rows_[i], chosen, size.columns);
  if (shown < rows_.size() && room > 0)
    text += Clipped(fmt::format("... {} more", rows_.size() - shown), size.columns) + "\n";
  return text;
}

std::string TextTable::Render() const {
  constexpr int kEndless = std::numeric_limits<int>::max();
  return Render({kEndless, kEndless});
}

int Characters(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return !IsUtf8Continuation(c); }));
}

std::string Clipped(const std::string& text, int columns) {
  if (Characters(text) <= columns) return text;
  return columns <= 0 ? "" : text.substr(0, ByteOf(text, columns - 1)) + "…";
}

std::string Wrapped(const std::string& text, int columns, int indent) {
  std::string lines, rest = text;
  while (Characters(rest) > columns) {
    const auto first = rest.find_first_not_of(' ');
    auto blank = rest.rfind(' ', ByteOf(rest, columns));
    if (blank == std::string::npos || blank < first) blank = rest.find(' ', std::min(first, rest.size()));
    const auto next = blank == std::string::npos ? blank : rest.find_first_not_of(' ', blank);
    if (next == std::string::npos) break;
    lines += Clipped(rest.substr(0, rest.find_last_not_of(' ', blank) + 1), columns) + "\n";
    rest = std::string(static_cast<std::size_t>(indent), ' ') + rest.substr(next);
  }
  return lines + Clipped(rest, columns) + "\n";
}

int Lines(std::string_view text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace priamos::cli
