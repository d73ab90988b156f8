#include "bus/schema/json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "bus/schema/walk.hpp"
#include "bus/type_files.hpp"
#include "encoding.hpp"
#include "foreign_messages.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "priamos/path_t.hpp"
#include "random_message.hpp"

namespace priamos::bus {
namespace {

Schema Foreign() {
  return Schema(ReadTypeFiles(PRIAMOS_SOURCE_DIR "/test/bus/schema/foreign"));
}

std::string ErrorOf(const Struct& type, const char* json) {
  try {
    FromJson(type, Json::parse(json));
  } catch (const MessageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Json, ShowsFieldsInTheOrderOfTheType) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  path_t path{};
  path.utime = 5;
  path.path_id = 2;
  path.speed_m_s = 0.25;
  path.n_points = 1;
  path.points.resize(1);
  path.points[0].x_m = -1.5;
  EXPECT_EQ(ToJson(*schema.Find("path_t"), Encode(path)).dump(),
            R"({"utime":5,"path_id":2,"estop_changes":0,"speed_m_s":0.25,"centre":false,"n_points":1,)"
            R"("points":[{"x_m":-1.5,"y_m":0.0,"yaw_rad":0.0,"left_m":0.0,"right_m":0.0}]})");
}

TEST(Json, KeepsEveryPrimitiveOfAForeignMessage) {
  const Schema schema = Foreign();
  const Struct& type = *schema.Find("everything_t");
  const Bytes bytes = Encode(FullMessage());
  const Json json = ToJson(type, bytes);
  EXPECT_EQ(json["i64"].get<std::int64_t>(), -9223372036854775807LL);
  EXPECT_EQ(json["f"].get<float>(), 0.1F);
  EXPECT_EQ(json["s"], "text \"quoted\" \xC3\xA4");
  EXPECT_EQ(json["b"], true);
  EXPECT_EQ(json["raw"], 200);
  EXPECT_EQ(json["blob"], "AQL/");
  EXPECT_EQ(json["grid"][1][2][3], 1.5);
  EXPECT_EQ(json["cube"][1][1][1], 7);
  EXPECT_EQ(json["tree"]["children"][0]["name"], "leaf");
  EXPECT_EQ(FromJson(type, Json::parse(json.dump())), bytes);
}

TEST(Json, WrittenTextGivesTheGeneratedTypeBack) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  const Bytes bytes =
      FromJson(*schema.Find("path_t"), Json::parse(R"({"utime": 9223372036854775807, "path_id": 2.0,
      "estop_changes": 0, "speed_m_s": 1, "centre": true, "points": [{"x_m": 1, "y_m": "NaN", "yaw_rad": "-Infinity",
      "left_m": 0, "right_m": 0.5}]})"));
  const auto path = Decode<path_t>(bytes);
  EXPECT_EQ(path.utime, std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(path.path_id, 2);
  EXPECT_EQ(path.n_points, 1);  // left out above: the array says it
  EXPECT_TRUE(std::isnan(path.points[0].y_m));
  EXPECT_EQ(path.points[0].yaw_rad, -std::numeric_limits<double>::infinity());
}

TEST(Json, KeepsStringsThatAreNoUtf8AndBooleansThatAreNone) {
  const Schema schema = SchemaOf("struct s { string a; boolean b; }");
  const Struct& type = *schema.Find("s");
  const Bytes bytes = MessageBuilder(type).Text("\xFF\x80").Put<std::int8_t>(-2).bytes();
  const Json json = ToJson(type, bytes);
  EXPECT_EQ(json.dump(), R"({"a":{"base64":"/4A="},"b":-2})");
  EXPECT_EQ(FromJson(type, json), bytes);
}

TEST(Json, RandomMessagesOfEveryTypeSurviveTheTextForm) {
  for (const Schema& schema : {Schema::FromTexts(EmbeddedTypes()), Foreign()}) {
    Rng rng(1);
    for (const Struct* type : schema.All()) {
      for (int i = 0; i < 50; ++i) {
        const Bytes bytes = RandomMessage(*type, Values::kAny, rng);
        const Json json = Json::parse(ToJson(*type, bytes).dump());
        // NaN has many encodings and JSON one name: compare what the bytes mean.
        ASSERT_EQ(ToJson(*type, FromJson(*type, json)), json) << type->full_name;
      }
    }
  }
}

TEST(Json, RefusesMalformedBytesWithAReason) {
  const Schema schema = SchemaOf("struct s { int16_t a; }");
  const Struct& type = *schema.Find("s");
  try {
    ToJson(type, MessageBuilder(type).Put<std::int8_t>(0).bytes());
    FAIL();
  } catch (const MessageError& error) {
    EXPECT_STREQ(error.what(), "s: byte 9 of 9: the message ends within a field");
  }
}

TEST(Json, RefusesWithTheFieldsName) {
  const Schema schema = SchemaOf(
      "struct s { int8_t n; p a[n]; byte raw[2]; boolean b; string t; float f; int64_t k; } struct p { "
      "double x; }");
  const Struct& type = *schema.Find("s");
  const std::string rest = R"("raw": "AAA=", "b": true, "t": "", "f": 1, "k": 1})";
  const auto with = [&](const std::string& begin) { return ErrorOf(type, (begin + rest).c_str()); };
  EXPECT_EQ(with(R"({"n": 1, "a": [{"x": 1}], )"), "no error");
  EXPECT_EQ(with(R"({"n": 1, "a": [{"x": "much"}], )"), "s.a[0].x: expected a number, got \"much\"");
  EXPECT_EQ(with(R"({"n": 1, "a": [{}], )"), "s.a[0].x: the field is missing");
  EXPECT_EQ(with(R"({"n": 1, "a": [{"x": 1, "y": 2}], )"), "s.a[0].y: there is no such field");
  EXPECT_EQ(with(R"({"n": 2, "a": [{"x": 1}], )"), "s.a: expected 2 elements, as n says, got [{\"x\":1}]");
  EXPECT_EQ(with(R"({"n": -1, "a": [], )"), "s.a: expected -1 elements, as n says, got []");
  EXPECT_EQ(with(R"({"n": 128, "a": [], )"), "s.n: expected a whole number from -128 to 127, got 128");
  EXPECT_EQ(with(R"({"n": 0.5, "a": [], )"), "s.n: expected a whole number from -128 to 127, got 0.5");
  EXPECT_EQ(with(R"({"n": "1", "a": [], )"), "s.n: expected a whole number from -128 to 127, got \"1\"");
  EXPECT_EQ(with(R"({"a": 3, )"), "s.a: expected an array, got 3");
  EXPECT_EQ(with(R"({"n": 0, )"), "s.a: the field is missing");
  EXPECT_EQ(ErrorOf(type, "[]"), "s: expected an object, got []");
}

TEST(Json, TheLargestFloatsSurviveTheirEightDigits) {
  const Schema schema = SchemaOf("struct f { float v; }");
  const Struct& type = *schema.Find("f");
  for (const char* written : {"3.4028235e+38", "-3.4028235e+38"}) {
    const Bytes bytes = FromJson(type, Json::parse(std::string("{\"v\": ") + written + "}"));
    EXPECT_EQ(std::abs(ToJson(type, bytes)["v"].get<float>()), std::numeric_limits<float>::max()) << written;
  }
  EXPECT_EQ(ErrorOf(type, R"({"v": 3.4028236e+38})"),
            "f.v: expected a number that fits into a float, got 3.4028236e+38");
}

TEST(Json, RefusesNumbersAndBytesThatDoNotFit) {
  const Schema schema = SchemaOf(
      "struct f { float v; } struct k { int64_t v; } struct b { byte v[2]; } struct t { string v; }");
  EXPECT_EQ(ErrorOf(*schema.Find("f"), R"({"v": 1e39})"),
            "f.v: expected a number that fits into a float, got 1e+39");
  EXPECT_EQ(ErrorOf(*schema.Find("k"), R"({"v": 9223372036854775808})"),
            "k.v: expected a whole number from -9223372036854775808 to 9223372036854775807, got "
            "9223372036854775808");
  EXPECT_EQ(ErrorOf(*schema.Find("k"), R"({"v": 1e19})"),
            "k.v: expected a whole number from -9223372036854775808 to 9223372036854775807, got 1e+19");
  EXPECT_EQ(ErrorOf(*schema.Find("b"), R"({"v": "AA=="})"), "b.v: expected 2 elements, got \"AA==\"");
  EXPECT_EQ(ErrorOf(*schema.Find("b"), R"({"v": "A"})"), "b.v: expected base64, got \"A\"");
  EXPECT_EQ(ErrorOf(*schema.Find("t"), R"({"v": 1})"), "t.v: expected a string, got 1");
}

TEST(Json, RefusesNestingBeyondWhatWalkTakes) {
  const Schema schema = SchemaOf("struct s { int8_t n; s c[n]; }");
  std::string text = R"({"c": []})";
  for (int i = 0; i < kMaxWalkDepth; ++i) text.assign(R"({"c": [)" + text + "]}");
  EXPECT_NE(ErrorOf(*schema.Find("s"), text.c_str()).find("structs are nested too deeply"),
            std::string::npos);
}

}  // namespace
}  // namespace priamos::bus
