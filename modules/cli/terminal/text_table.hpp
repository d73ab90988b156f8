#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace priamos::cli {

/// Size of a terminal in characters.
struct ScreenSize {
  int columns = 80, rows = 24;
};

/// One column of a table.
struct Column {
  std::string title;
  int worth = 0;         ///< where there is no room for all, those of least worth go first
  bool is_text = false;  ///< stands on the left; numbers stand on the right
};

/// Rows of text under a header.
class TextTable {
 public:
  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// One cell per column.
  void Add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

  /// Lines of at most `size.columns` characters, at most `size.rows` of them, but always the header: columns
  /// are left out by worth, and rows that do not fit are counted in a last line, "... 3 more".
  std::string Render(ScreenSize size) const;
  /// All columns and rows.
  std::string Render() const;

 private:
  std::vector<std::size_t> Chosen(int width) const;
  std::string Line(const std::vector<std::string>& cells, const std::vector<std::size_t>& chosen,
                   int width) const;
  int WidthOf(std::size_t column) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Number of characters of UTF-8 text.
int Characters(std::string_view text);
/// The first `columns` characters; what is cut off shows as an ellipsis.
std::string Clipped(const std::string& text, int columns);
/// A sentence broken at blanks into lines of at most `columns` characters, later ones indented; each ends
/// with a line feed.
std::string Wrapped(const std::string& text, int columns, int indent = 2);
/// Number of line feeds.
int Lines(std::string_view text);

}  // namespace priamos::cli
