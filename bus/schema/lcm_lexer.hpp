#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace priamos::bus {

/// One word of a .lcm file.
struct Token {
  /// Sort of a token; kEnd stands once, behind the last word. The text of kWrong is a sentence: what is there
  /// has no place in a .lcm file.
  enum class Type : std::uint8_t { kWord, kNumber, kSymbol, kComment, kWrong, kEnd };
  Type type = Type::kEnd;
  std::string text;          ///< the characters; a comment without its marks, lines joined by blanks
  int line = 0;              ///< where its first character stands, from 1
  int last_line = 0;         ///< line of its last character
  int column = 0;            ///< where its first character stands, from 1
  bool starts_line = false;  ///< nothing but blanks before it
};

/// Cuts a .lcm text into tokens; the last one is kEnd. `//` comments that follow each other line by line in
/// the same column are one comment. Words may contain dots. A byte order mark before the text is no part of
/// it.
std::vector<Token> TokenizeLcm(std::string_view text);

}  // namespace priamos::bus
