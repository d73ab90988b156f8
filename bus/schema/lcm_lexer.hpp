#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace priamos::bus {

/// One word of a .lcm file.
struct Token {
  /// Sort of a token; kEnd stands once, behind the last word.
  enum class Type : std::uint8_t { kWord, kNumber, kSymbol, kComment, kEnd };
  Type type = Type::kEnd;
  std::string text;          ///< the characters; a comment without its marks, lines joined by blanks
  int line = 0;              ///< where its first character stands, from 1
  int last_line = 0;         ///< line of its last character
  int column = 0;            ///< where its first character stands, from 1
  bool starts_line = false;  ///< nothing but blanks before it
};

/// Cuts a .lcm text into tokens; the last one is kEnd. `//` comments that follow each other line by line in
/// the same column are one comment. Words may contain dots. Throws SchemaError with `file` and line.
std::vector<Token> TokenizeLcm(std::string_view file, std::string_view text);

}  // namespace priamos::bus
