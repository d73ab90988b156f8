#include "bus/schema/lcm_lexer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bus/schema/text_codec.hpp"

namespace priamos::bus {
namespace {

// std::isalpha and the like read the locale and are undefined for negative char.
bool IsDigit(char c) {
  return c >= '0' && c <= '9';
}
bool IsLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool IsBlank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) {
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  std::vector<Token> Run() {
    while (SkipBlanks()) {
      Begin();
      const char c = text_[pos_];
      if (text_.substr(pos_, 2) == "//") {
        LineComment();
      } else if (text_.substr(pos_, 2) == "/*") {
        BlockComment();
      } else if (IsLetter(c)) {
        Take(Token::Type::kWord, [](char x) { return IsLetter(x) || IsDigit(x) || x == '.'; });
      } else if (IsDigit(c) || ((c == '-' || c == '+' || c == '.') && IsDigit(At(1)))) {
        NumberToken();
      } else if (std::string_view("{}[];,=").find(c) != std::string_view::npos) {
        Take(Token::Type::kSymbol, [this](char) { return token_.text.empty(); });
      } else {
        Wrong(fmt::format("this character (code {}) has no place in a .lcm file",
                          static_cast<int>(static_cast<unsigned char>(c))),
              pos_ + 1);
      }
    }
    Begin();
    tokens_.push_back(token_);
    for (Token& token : tokens_)
      if (token.type == Token::Type::kComment) token.text = Utf8Of(token.text);
    return std::move(tokens_);
  }

 private:
  char At(std::size_t ahead) const { return pos_ + ahead < text_.size() ? text_[pos_ + ahead] : '\0'; }

  bool SkipBlanks() {
    while (pos_ < text_.size() && IsBlank(text_[pos_])) Advance();
    return pos_ < text_.size();
  }

  void Advance() {
    if (text_[pos_++] != '\n') return;
    ++line_;
    line_begin_ = pos_;
    line_empty_ = true;
  }

  void Begin() {
    token_ =
        Token{Token::Type::kEnd, "", line_, line_, static_cast<int>(pos_ - line_begin_) + 1, line_empty_};
    line_empty_ = false;
  }

  template <class Predicate>
  void Take(Token::Type type, Predicate belongs) {
    token_.type = type;
    while (pos_ < text_.size() && belongs(text_[pos_])) token_.text += text_[pos_++];
    tokens_.push_back(token_);
  }

  void NumberToken() {
    char before = '\0';
    Take(Token::Type::kNumber, [&before](char x) {
      const bool sign = (x == '-' || x == '+') && (before == '\0' || before == 'e' || before == 'E');
      const bool belongs = sign || IsDigit(x) || IsLetter(x) || x == '.';
      before = x;
      return belongs;
    });
  }

  void LineComment() {
    const std::size_t end = std::min(text_.find('\n', pos_), text_.size());
    token_.type = Token::Type::kComment;
    token_.text = Stripped(text_.substr(pos_, end - pos_), "/!<");
    pos_ = end;
    Token* last = tokens_.empty() ? nullptr : &tokens_.back();
    if (last != nullptr && last->type == Token::Type::kComment && token_.starts_line &&
        last->last_line + 1 == token_.line && last->column == token_.column) {
      last->text += (last->text.empty() || token_.text.empty() ? "" : " ") + token_.text;
      last->last_line = token_.line;
    } else {
      tokens_.push_back(token_);
    }
  }

  void BlockComment() {
    const std::size_t end = text_.find("*/", pos_ + 2);
    if (end == std::string_view::npos) return Wrong("the comment is not closed", text_.size());
    token_.type = Token::Type::kComment;
    std::string line;
    const auto flush = [&] {
      const std::string words = Stripped(line, "/*!<");
      token_.text += (token_.text.empty() || words.empty() ? "" : " ") + words;
      line.clear();
    };
    while (pos_ < end) {
      if (text_[pos_] == '\n') flush();
      line += text_[pos_];
      Advance();
    }
    flush();
    token_.last_line = line_;
    line_empty_ = false;
    pos_ = end + 2;
    tokens_.push_back(token_);
  }

  /// Text without blanks on both ends and without leading comment marks.
  static std::string Stripped(std::string_view text, std::string_view marks) {
    while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && marks.find(text.front()) != std::string_view::npos) text.remove_prefix(1);
    while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
    return std::string(text);
  }

  /// What stands here is no token; the text goes on at `end`.
  void Wrong(std::string sentence, std::size_t end) {
    token_.type = Token::Type::kWrong;
    token_.text = std::move(sentence);
    tokens_.push_back(token_);
    pos_ = end;
  }

  std::string_view text_;
  std::size_t pos_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  bool line_empty_ = true;
  Token token_;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> TokenizeLcm(std::string_view text) {
  return Lexer(text).Run();
}

}  // namespace priamos::bus
