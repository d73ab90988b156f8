#include "bus/schema/json_schema.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "encoding.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "random_message.hpp"

namespace priamos::bus {
namespace {

/// The part of JSON Schema that JsonSchemaOf uses.
bool Agrees(const Json& schema, const Json& value) {
  const std::string kind = schema["type"];
  if (kind == "integer") return value.is_number_integer();
  if (kind == "number")
    return value.is_number() || value == "NaN" || value == "Infinity" || value == "-Infinity";
  if (kind == "boolean") return value.is_boolean();
  if (kind == "string") return value.is_string();
  if (kind == "array") {
    if (!value.is_array() || (schema.contains("minItems") && value.size() != schema["minItems"]))
      return false;
    return std::all_of(value.begin(), value.end(), [&](const Json& v) { return Agrees(schema["items"], v); });
  }
  if (kind != "object" || !value.is_object() || value.size() != schema["properties"].size()) return false;
  for (const auto& [name, property] : schema["properties"].items()) {
    if (!value.contains(name) || !Agrees(property, value[name])) return false;
  }
  return true;
}

TEST(JsonSchema, DescribesWhatToJsonMakesOfEveryType) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  Rng rng(1);
  for (const Struct* type : schema.All()) {
    const Json dut = JsonSchemaOf(*type);
    for (int i = 0; i < 20; ++i) {
      const Json message = ToJson(*type, RandomMessage(*type, Values::kAny, rng));
      EXPECT_TRUE(Agrees(dut, message)) << type->full_name << message.dump();
    }
  }
}

TEST(JsonSchema, CarriesUnitFrameRangeAndMeaning) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  const Json dut = JsonSchemaOf(*schema.Find("pose_t"));
  EXPECT_EQ(dut["title"], "priamos.pose_t");
  EXPECT_EQ(dut["properties"]["x_m"]["description"],
            "[m] in frame map, from -100 to 100: position of the base centre");
  EXPECT_EQ(dut["required"].size(), schema.Find("pose_t")->fields.size());
}

TEST(JsonSchema, BytesAreBase64AndFixedArraysHaveTheirLength) {
  const Schema schema = SchemaOf("struct s { byte raw[2][4]; int8_t n; float f[n]; }");
  const Json dut = JsonSchemaOf(*schema.Find("s"))["properties"];
  EXPECT_EQ(dut["raw"].dump(), R"({"type":"array","items":{"type":"string","contentEncoding":"base64"},)"
                               R"("minItems":2,"maxItems":2})");
  EXPECT_EQ(dut["f"].dump(), R"({"type":"array","items":{"type":"number"}})");
}

TEST(JsonSchema, RefusesTypesThatDoubleOften) {
  std::string text = "struct c45_t {}";
  for (int i = 44; i >= 0; --i) text += fmt::format("struct c{0}_t {{ c{1}_t a; c{1}_t b; }}", i, i + 1);
  const Schema schema = SchemaOf(text);
  EXPECT_THROW(JsonSchemaOf(*schema.Find("c0_t")), SchemaError);
  EXPECT_NO_THROW(JsonSchemaOf(*schema.Find("c40_t")));
}

TEST(JsonSchema, RefusesTypesThatContainThemselves) {
  const Schema schema = SchemaOf("struct s { int8_t n; s child[n]; }");
  EXPECT_THROW(JsonSchemaOf(*schema.Find("s")), SchemaError);
}

}  // namespace
}  // namespace priamos::bus
