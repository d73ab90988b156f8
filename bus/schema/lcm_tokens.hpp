#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bus/schema/lcm_lexer.hpp"

namespace priamos::bus {

/// The tokens of one .lcm text, read one after the other. What is not as expected throws SchemaError,
/// `file:line: expected ..., got ...`.
class LcmTokens {
 public:
  LcmTokens(std::string_view file, std::string_view text) : file_(file), tokens_(TokenizeLcm(text)) {}

  /// The next token that is no comment; it stays the next one.
  const Token& Peek();
  /// Takes the next token that is no comment. The reference holds until the next call.
  const Token& Next();
  /// The token taken last.
  const Token& last() const { return last_; }
  void Expect(std::string_view symbol);
  /// Takes a comma or a semicolon, and returns it.
  std::string Separator();
  /// Takes a word; `what` names in an error what was expected.
  std::string Word(std::string_view what);

  /// Skips the comments here; returns the last one when what follows begins on the next line at the latest.
  std::string LeadingComment();
  /// The comment on the line of the token read last, with the lines below it in the same column.
  std::string TrailingComment();

  /// True before `struct name {` or `enum name {`.
  bool BeginsType() const;
  /// To the end of a declaration that cannot be read: behind its brace, or where the next one begins.
  void SkipDeclaration();

  [[noreturn]] void Fail(const Token& token, std::string_view sentence) const;

 private:
  bool IsWord(std::string_view text) const;
  std::string_view TextBehind(int n) const;

  std::string file_;
  std::vector<Token> tokens_;
  std::size_t pos_ = 0;
  Token last_;
};

}  // namespace priamos::bus
