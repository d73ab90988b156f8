#include "bus/schema/lcm_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bus/schema/annotation.hpp"
#include "bus/schema/c_integer.hpp"
#include "bus/schema/lcm_tokens.hpp"

namespace priamos::bus {
namespace {

bool FitsInto(Kind kind, std::int64_t value) {
  const int bits = static_cast<int>(8 * WireSize(kind));
  return bits == 64 || (value >= -(std::int64_t{1} << (bits - 1)) && value < (std::int64_t{1} << (bits - 1)));
}

/// More than anybody writes. What walks an array calls itself once per dimension.
constexpr std::size_t kMostDimensions = 32;

/// Recursive descent; one function per rule of the grammar.
class Parser : private LcmTokens {
 public:
  Parser(std::string_view file, std::string_view text) : LcmTokens(file, text), file_(file) {}

  /// All types that can be read. One that cannot does not hinder those behind it.
  std::vector<Struct> Run(std::vector<TypeProblem>& problems) {
    for (bool strange = false;;) {
      current_.clear();
      try {
        if (!ParseDeclaration()) return std::move(structs_);
      } catch (const SchemaError& error) {
        // What is no type at all may go on for a whole file: its first line says enough.
        if (!current_.empty() || !strange) problems.push_back({current_, error.what()});
        strange = strange || current_.empty();
        SkipDeclaration();
      }
    }
  }

 private:
  /// Returns false at the end of the text.
  bool ParseDeclaration() {
    const std::string doc = LeadingComment();
    const Token& token = Next();
    if (token.type == Token::Type::kEnd) return false;
    if (token.text == "package") {
      package_ = Word("the name of the package");
      Expect(";");
    } else if (token.text == "struct") {
      ParseStruct(doc);
    } else if (token.text == "enum") {
      const Token keyword = token;
      current_ = FullName(Word("the name of the enum"));
      Fail(keyword, "enum types are not supported, use constants in a struct");
    } else if (token.text != ";") {
      Fail(token, fmt::format("expected 'package' or 'struct', got '{}'", token.text));
    }
    return true;
  }

  std::string FullName(const std::string& name) const {
    return package_.empty() ? name : package_ + "." + name;
  }

  void ParseStruct(const std::string& doc) {
    Struct type;
    type.line = Peek().line;
    type.file = file_;
    type.package = package_;
    type.doc = doc;
    type.name = Word("the name of the struct");
    if (PrimitiveKind(type.name)) Fail(last(), fmt::format("'{}' is a primitive type of LCM", type.name));
    type.full_name = current_ = FullName(type.name);
    Expect("{");
    while (true) {
      const std::string leading = LeadingComment();
      if (Peek().text == "}") break;
      if (BeginsType())
        Fail(Peek(),
             fmt::format("expected a field or '}}', got '{}': LCM has no types within types", Peek().text));
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
      Fail(last(),
           fmt::format("a constant cannot be of type {}, only integers, float and double", kind_name));
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
    if (!kind && prototype.type_name.find('.') == std::string::npos) {
      prototype.type_name = FullName(prototype.type_name);
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
    if (field.dims.size() == kMostDimensions)
      Fail(token, fmt::format("expected at most {} dimensions of an array, got more", kMostDimensions));
    Dimension dimension;
    dimension.text = token.text;
    if (token.type == Token::Type::kNumber) {
      const auto size = ParseCInteger(token.text);
      if (!size || *size <= 0 || *size > std::numeric_limits<std::int32_t>::max()) {
        Fail(token, fmt::format("the array size '{}' is not a whole number above 0", token.text));
      }
      dimension.size = *size;
    } else if (const Constant* constant = ConstantOf(type, token)) {
      dimension.text = constant->text;  // as if it stood there: LCM's fingerprint does not know the name
      dimension.size = SizeOf(*constant, token);
    } else if (token.type == Token::Type::kWord) {
      dimension.variable = true;
      dimension.count_field = CountField(type, token);
    } else {
      Fail(token, fmt::format("expected the size of the array, got '{}'", token.text));
    }
    Expect("]");
    field.dims.push_back(std::move(dimension));
  }

  static const Constant* ConstantOf(const Struct& type, const Token& token) {
    const auto found = std::find_if(type.constants.begin(), type.constants.end(),
                                    [&](const Constant& c) { return c.name == token.text; });
    return found == type.constants.end() ? nullptr : &*found;
  }

  std::int64_t SizeOf(const Constant& constant, const Token& token) const {
    const auto size = IsInteger(constant.kind) ? constant.value.integer.value_or(0) : 0;
    if (size <= 0 || size > std::numeric_limits<std::int32_t>::max()) {
      Fail(token, fmt::format("the array size '{}' is {}, not a whole number above 0", constant.name,
                              constant.text));
    }
    return size;
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
      Fail(last(), fmt::format("the name '{}' is used twice in {}", name, type.full_name));
    }
  }

  std::string file_;
  std::string package_;
  std::string current_;  ///< full name of the type that is being read
  std::vector<Struct> structs_;
};

}  // namespace

std::vector<Struct> ParseLcm(std::string_view file, std::string_view text,
                             std::vector<TypeProblem>& problems) {
  return Parser(file, text).Run(problems);
}

std::vector<Struct> ParseLcm(std::string_view file, std::string_view text) {
  std::vector<TypeProblem> problems;
  std::vector<Struct> types = ParseLcm(file, text, problems);
  if (!problems.empty()) throw SchemaError(problems.front().sentence);
  return types;
}

}  // namespace priamos::bus
