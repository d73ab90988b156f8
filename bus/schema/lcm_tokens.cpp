#include "bus/schema/lcm_tokens.hpp"

#include <fmt/format.h>

#include "bus/schema/model.hpp"

namespace priamos::bus {
namespace {

std::string Got(const Token& token) {
  return token.type == Token::Type::kEnd ? "the end of the file" : fmt::format("'{}'", token.text);
}

}  // namespace

const Token& LcmTokens::Peek() {
  while (tokens_[pos_].type == Token::Type::kComment) ++pos_;
  return tokens_[pos_];
}

const Token& LcmTokens::Next() {
  last_ = Peek();
  if (last_.type != Token::Type::kEnd) ++pos_;
  if (last_.type == Token::Type::kWrong) Fail(last_, last_.text);
  return last_;
}

void LcmTokens::Expect(std::string_view symbol) {
  const Token& token = Next();
  if (token.text != symbol) Fail(token, fmt::format("expected '{}', got {}", symbol, Got(token)));
}

std::string LcmTokens::Separator() {
  const Token& token = Next();
  if (token.text != ";" && token.text != ",") Fail(token, fmt::format("expected ';', got {}", Got(token)));
  return token.text;
}

std::string LcmTokens::Word(std::string_view what) {
  const Token& token = Next();
  if (token.type != Token::Type::kWord) Fail(token, fmt::format("expected {}, got {}", what, Got(token)));
  return token.text;
}

std::string LcmTokens::LeadingComment() {
  std::string text;
  for (; tokens_[pos_].type == Token::Type::kComment; ++pos_) {
    const Token& comment = tokens_[pos_];
    text = comment.last_line + 1 >= tokens_[pos_ + 1].line ? comment.text : "";
  }
  return text;
}

std::string LcmTokens::TrailingComment() {
  if (tokens_[pos_].type != Token::Type::kComment || tokens_[pos_].line != last_.last_line) return "";
  return tokens_[pos_++].text;
}

bool LcmTokens::BeginsType() const {
  return (IsWord("struct") || IsWord("enum")) && TextBehind(2) == "{";
}

void LcmTokens::SkipDeclaration() {
  for (; tokens_[pos_].type != Token::Type::kEnd; ++pos_) {
    if (BeginsType() || (IsWord("package") && TextBehind(2) == ";")) return;
    if (tokens_[pos_].type == Token::Type::kSymbol && tokens_[pos_].text == "}") {
      ++pos_;
      return;
    }
  }
}

void LcmTokens::Fail(const Token& token, std::string_view sentence) const {
  throw SchemaError(fmt::format("{}:{}: {}", file_, token.line, sentence));
}

bool LcmTokens::IsWord(std::string_view text) const {
  return tokens_[pos_].type == Token::Type::kWord && tokens_[pos_].text == text;
}

/// Text of the n-th token from here, comments not counted.
std::string_view LcmTokens::TextBehind(int n) const {
  std::size_t at = pos_;
  while (n > 0 && tokens_[at].type != Token::Type::kEnd)
    if (tokens_[++at].type != Token::Type::kComment) --n;
  return tokens_[at].text;
}

}  // namespace priamos::bus
