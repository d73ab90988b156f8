#include "bus/schema/model.hpp"

#include <fmt/format.h>

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

std::string Struct::Where(const Field& field) const {
  return fmt::format("{}:{}: {}.{}: ", file, field.line, full_name, field.name);
}

}  // namespace priamos::bus
