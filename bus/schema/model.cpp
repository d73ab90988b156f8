#include "bus/schema/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace priamos::bus {
namespace {

struct KindRow {
  std::string_view name;
  std::size_t wire_size;
};

// In the order of Kind.
constexpr std::array<KindRow, 10> kKinds{{{"int8_t", 1},
                                          {"int16_t", 2},
                                          {"int32_t", 4},
                                          {"int64_t", 8},
                                          {"float", 4},
                                          {"double", 8},
                                          {"boolean", 1},
                                          {"byte", 1},
                                          {"string", 0},
                                          {"struct", 0}}};

bool IsOfAName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The names in a text: runs of letters, digits and underscores.
std::vector<std::string_view> WordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  while (true) {
    const auto begin = std::find_if(text.begin(), text.end(), IsOfAName);
    const auto end = std::find_if_not(begin, text.end(), IsOfAName);
    if (begin == end) return words;
    words.emplace_back(begin, end);
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  }
}

}  // namespace

std::string_view KindName(Kind kind) {
  return kKinds[static_cast<std::size_t>(kind)].name;
}

std::optional<Kind> PrimitiveKind(std::string_view name) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(Kind::kStruct); ++i) {
    if (kKinds[i].name == name) return static_cast<Kind>(i);
  }
  return std::nullopt;
}

std::size_t WireSize(Kind kind) {
  return kKinds[static_cast<std::size_t>(kind)].wire_size;
}

bool IsInteger(Kind kind) {
  return kind <= Kind::kInt64;
}

bool Struct::IsEnumeration(const Field& field) const {
  if (!IsInteger(field.kind) || field.annotation.age_us) return false;
  const auto words = WordsOf(field.annotation.meaning);
  return std::any_of(constants.begin(), constants.end(), [&](const Constant& constant) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
      return word == constant.name || (word.ends_with('_') && constant.name.starts_with(word));
    });
  });
}

std::string Struct::Where(const Field& field) const {
  return fmt::format("{}:{}: {}.{}: ", file, field.line, full_name, field.name);
}

}  // namespace priamos::bus
