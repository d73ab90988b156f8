#include "bus/schema/lcm_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bus/schema/annotation.hpp"
#include "bus/schema/lcm_lexer.hpp"
#include "common/number_text.hpp"

namespace priamos::bus {
namespace {

/// A whole number in C notation, decimal, 0x.. or 0.. (octal): lcm-gen copies it into C++ as it is.
std::optional<std::int64_t> ParseCInteger(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  int base = 10;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    base = 16;
    text.remove_prefix(2);
  } else if (text.size() > 1 && text.front() == '0') {
    base = 8;
  }
  const auto magnitude = NumberOf<std::uint64_t>(text, base);
  if (!magnitude) return std::nullopt;
  constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (*magnitude > kMax + (negative ? 1 : 0)) return std::nullopt;
  return static_cast<std::int64_t>(negative ? 0 - *magnitude : *magnitude);
}

bool FitsInto(Kind kind, std::int64_t value) {
  const int bits = static_cast<int>(8 * WireSize(kind));
  return bits == 64 || (value >= -(std::int64_t{1} << (bits - 1)) && value < (std::int64_t{1} << (bits - 1)));
}

/// Recursive descent; one function per rule of the grammar.
class Parser {
 public:
  Parser(std::string_view file, std::string_view text) : file_(file), tokens_(TokenizeLcm(file, text)) {}

  std::vector<Struct> Run() {
    while (true) {
      const std::string doc = LeadingComment();
      const Token& token = Next();
      if (token.type == Token::Type::kEnd) return std::move(structs_);
      if (token.text == ";") continue;
      if (token.text == "package") {
        package_ = Word("the name of the package");
        Expect(";");
      } else if (token.text == "struct") {
        ParseStruct(doc);
      } else if (token.text == "enum") {
        Fail(token, "enum types are not supported, use constants in a struct");
      } else {
        Fail(token, fmt::format("expected 'package' or 'struct', got '{}'", token.text));
      }
    }
  }

 private:
  void ParseStruct(const std::string& doc) {
    Struct type;
    type.line = Peek().line;
    type.file = file_;
    type.package = package_;
    type.doc = doc;
    type.name = Word("the name of the struct");
    if (PrimitiveKind(type.name)) Fail(last_, fmt::format("'{}' is a primitive type of LCM", type.name));
    type.full_name = package_.empty() ? type.name : package_ + "." + type.name;
    Expect("{");
    while (true) {
      const std::string leading = LeadingComment();
      if (Peek().text == "}") break;
      if (Peek().text == "const") {
        ParseConstants(type);
      } else {
        ParseFields(type, leading);
      }
    }
    Expect("}");
    structs_.push_back(std::move(type));
  }

  void ParseConstants(Struct& type) {
    Expect("const");
    const std::string kind_name = Word("the type of the constant");
    const auto kind = PrimitiveKind(kind_name);
    if (!kind || *kind > Kind::kDouble) {
      Fail(last_, fmt::format("a constant cannot be of type {}, only integers, float and double", kind_name));
    }
    do {
      Constant constant;
      constant.line = Peek().line;
      constant.kind = *kind;
      constant.name = Word("the name of the constant");
      RefuseTaken(type, constant.name);
      Expect("=");
      const Token& value = Next();
      constant.text = value.text;
      constant.value = ConstantValue(*kind, value);
      type.constants.push_back(std::move(constant));
    } while (Separator() == ",");
  }

  Number ConstantValue(Kind kind, const Token& token) const {
    if (IsInteger(kind)) {
      const auto integer = ParseCInteger(token.text);
      if (!integer || !FitsInto(kind, *integer)) {
        Fail(token, fmt::format("'{}' is no {}", token.text, KindName(kind)));
      }
      return {static_cast<double>(*integer), integer};
    }
    const auto number = ParseNumber(token.text);
    if (!number) Fail(token, fmt::format("'{}' is no number", token.text));
    return *number;
  }

  /// A declaration, `type name[dim]..., name ...;`, and its comments.
  void ParseFields(Struct& type, const std::string& leading) {
    Field prototype;
    prototype.type_name = Word("the type of a field");
    const auto kind = PrimitiveKind(prototype.type_name);
    prototype.kind = kind.value_or(Kind::kStruct);
    if (!kind && prototype.type_name.find('.') == std::string::npos && !package_.empty()) {
      prototype.type_name = package_ + "." + prototype.type_name;
    }
    const std::size_t first = type.fields.size();
    std::vector<std::string> own_comments;
    std::string separator;
    do {
      Field field = prototype;
      field.line = Peek().line;
      field.name = Word("the name of the field");
      RefuseTaken(type, field.name);
      while (Peek().text == "[") ParseDimension(type, field);
      type.fields.push_back(std::move(field));
      separator = Separator();
      own_comments.push_back(TrailingComment());
    } while (separator == ",");
    // A comment behind the semicolon belongs to every field of the declaration that has none of its own.
    for (std::size_t i = first; i < type.fields.size(); ++i) {
      const std::string& own = own_comments[i - first];
      Annotate(type.fields[i], leading, own.empty() ? own_comments.back() : own);
    }
  }

  void ParseDimension(const Struct& type, Field& field) {
    Expect("[");
    const Token& token = Next();
    Dimension dimension;
    dimension.text = token.text;
    if (token.type == Token::Type::kNumber) {
      const auto size = ParseCInteger(token.text);
      if (!size || *size <= 0 || *size > std::numeric_limits<std::int32_t>::max()) {
        Fail(token, fmt::format("the array size '{}' is not a whole number above 0", token.text));
      }
      dimension.size = *size;
    } else if (token.type == Token::Type::kWord) {
      dimension.variable = true;
      dimension.count_field = CountField(type, token);
    } else {
      Fail(token, fmt::format("expected the size of the array, got '{}'", token.text));
    }
    Expect("]");
    field.dims.push_back(std::move(dimension));
  }

  std::size_t CountField(const Struct& type, const Token& token) const {
    const auto found = std::find_if(type.fields.begin(), type.fields.end(),
                                    [&](const Field& f) { return f.name == token.text; });
    if (found == type.fields.end()) {
      Fail(token, fmt::format("the array size '{}' is no field declared before the array", token.text));
    }
    if (!IsInteger(found->kind) || !found->dims.empty()) {
      Fail(token, fmt::format("the array size '{}' is not a single integer field", token.text));
    }
    return static_cast<std::size_t>(found - type.fields.begin());
  }

  void Annotate(Field& field, const std::string& leading, const std::string& trailing) const {
    field.comment = leading + (leading.empty() || trailing.empty() ? "" : " ") + trailing;
    for (const std::string* part : {&trailing, &leading}) {
      if (part->starts_with('[')) {
        field.annotation = ParseAnnotation(*part);
        return;
      }
    }
    field.annotation = ParseAnnotation(field.comment);
  }

  void RefuseTaken(const Struct& type, const std::string& name) const {
    const auto same = [&](const auto& member) { return member.name == name; };
    if (std::any_of(type.fields.begin(), type.fields.end(), same) ||
        std::any_of(type.constants.begin(), type.constants.end(), same)) {
      Fail(last_, fmt::format("the name '{}' is used twice in {}", name, type.full_name));
    }
  }

  /// Skips the comments here; returns the last one when what follows begins on the next line at the latest.
  std::string LeadingComment() {
    std::string text;
    for (; tokens_[pos_].type == Token::Type::kComment; ++pos_) {
      const Token& comment = tokens_[pos_];
      text = comment.last_line + 1 >= tokens_[pos_ + 1].line ? comment.text : "";
    }
    return text;
  }

  /// The comment on the line of the token read last, with the lines below it in the same column.
  std::string TrailingComment() {
    if (tokens_[pos_].type != Token::Type::kComment || tokens_[pos_].line != last_.last_line) return "";
    return tokens_[pos_++].text;
  }

  const Token& Peek() {
    while (tokens_[pos_].type == Token::Type::kComment) ++pos_;
    return tokens_[pos_];
  }

  const Token& Next() {
    last_ = Peek();
    if (last_.type != Token::Type::kEnd) ++pos_;
    return last_;
  }

  void Expect(std::string_view symbol) {
    const Token& token = Next();
    if (token.text != symbol) Fail(token, fmt::format("expected '{}', got '{}'", symbol, token.text));
  }

  std::string Separator() {
    const Token& token = Next();
    if (token.text != ";" && token.text != ",")
      Fail(token, fmt::format("expected ';', got '{}'", token.text));
    return token.text;
  }

  std::string Word(std::string_view what) {
    const Token& token = Next();
    if (token.type != Token::Type::kWord) Fail(token, fmt::format("expected {}, got '{}'", what, token.text));
    return token.text;
  }

  [[noreturn]] void Fail(const Token& token, std::string_view sentence) const {
    throw SchemaError(fmt::format("{}:{}: {}", file_, token.line, sentence));
  }

  std::string file_;
  std::vector<Token> tokens_;
  std::size_t pos_ = 0;
  Token last_;
  std::string package_;
  std::vector<Struct> structs_;
};

}  // namespace

std::vector<Struct> ParseLcm(std::string_view file, std::string_view text) {
  return Parser(file, text).Run();
}

}  // namespace priamos::bus
