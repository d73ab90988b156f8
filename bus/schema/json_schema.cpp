#include "bus/schema/json_schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "bus/schema/fingerprint.hpp"

namespace priamos::bus {
namespace {

/// Structs within each other that a schema describes: a text of 45 types can hold 2^45 of them.
constexpr std::size_t kMostStructs = 10'000;

/// Number of structs in a type that contains itself nowhere, at most a little more than kMostStructs.
class StructCount {
 public:
  std::size_t Of(const Struct& type) {
    if (const auto known = known_.find(&type); known != known_.end()) return known->second;
    std::size_t count = 1;
    for (const Field& field : type.fields)
      if (field.type != nullptr) count = std::min(count + Of(*field.type), kMostStructs + 1);
    return known_[&type] = count;
  }

 private:
  std::map<const Struct*, std::size_t> known_;
};

Json ObjectOf(const Struct& type);

Json ValueOf(const Field& field) {
  switch (field.kind) {
    case Kind::kStruct:
      return ObjectOf(*field.type);
    case Kind::kString:
      return {{"type", "string"}};
    case Kind::kBoolean:
      return {{"type", "boolean"}};
    case Kind::kFloat:
    case Kind::kDouble:
      return {{"type", "number"}};
    default:
      return {{"type", "integer"}};
  }
}

Json LevelOf(const Field& field, std::size_t level) {
  if (level == field.dims.size()) return ValueOf(field);
  if (field.kind == Kind::kByte && level + 1 == field.dims.size()) {
    return {{"type", "string"}, {"contentEncoding", "base64"}};
  }
  Json array{{"type", "array"}, {"items", LevelOf(field, level + 1)}};
  if (!field.dims[level].variable) {
    array["minItems"] = field.dims[level].size;
    array["maxItems"] = field.dims[level].size;
  }
  return array;
}

std::string DescriptionOf(const Field& field) {
  const Annotation& a = field.annotation;
  std::string text;
  if (!a.unit.empty() && a.unit != "-") text += fmt::format("[{}] ", a.unit);
  if (!a.frame.empty()) text += fmt::format("in frame {}, ", a.frame);
  if (a.min) text += fmt::format("from {} to {}: ", a.min->value, a.max->value);
  return text + a.meaning;
}

Json ObjectOf(const Struct& type) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const Field& field : type.fields) {
    Json& property = properties[field.name] = LevelOf(field, 0);
    if (const std::string text = DescriptionOf(field); !text.empty()) property["description"] = text;
    required.push_back(field.name);
  }
  Json object{{"title", type.full_name}, {"type", "object"}};
  if (!type.doc.empty()) object["description"] = type.doc;
  object["properties"] = std::move(properties);
  object["required"] = std::move(required);
  return object;
}

}  // namespace

Json JsonSchemaOf(const Struct& type) {
  if (ReachesRecursion(type)) {
    throw SchemaError(
        fmt::format("{}:{}: {} has a type in it that contains itself, which no flat JSON schema can describe",
                    type.file, type.line, type.full_name));
  }
  if (StructCount().Of(type) > kMostStructs) {
    throw SchemaError(
        fmt::format("{}:{}: expected a type of at most {} structs within each other, got {} with more",
                    type.file, type.line, kMostStructs, type.full_name));
  }
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}};
  schema.update(ObjectOf(type));
  return schema;
}

}  // namespace priamos::bus
