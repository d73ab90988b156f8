#include "cli/terminal/field_path.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "bus/schema/schema.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

const bus::Schema& Types() {
  static const std::vector<bus::Schema::Source> kSources{
      {"test.lcm",
       "package p; struct inner_t { double x_m; int8_t grid[2][3]; }\n"
       "struct outer_t { int32_t n; double ranges_m[n]; inner_t parts[2]; }"}};
  static const bus::Schema schema(kSources);
  return schema;
}

std::string ErrorOf(const std::string& text) {
  try {
    FieldPath(*Types().Find("outer_t"), text);
  } catch (const bus::MessageError& error) {
    return error.what();
  }
  return "";
}

bus::Json In(const std::string& text) {
  const auto message = bus::Json::parse(
      R"({"n":2,"ranges_m":[1.5,2.5],"parts":[{"x_m":3,"grid":[[1,2,3],[4,5,6]]},{"x_m":4,"grid":[[],[]]}]})");
  return FieldPath(*Types().Find("outer_t"), text).In(message);
}

TEST(FieldPath, FindsFieldsElementsAndFieldsOfElements) {
  EXPECT_EQ(In("n"), 2);
  EXPECT_EQ(In("ranges_m[1]"), 2.5);
  EXPECT_EQ(In("ranges_m"), bus::Json({1.5, 2.5}));
  EXPECT_EQ(In("parts[1].x_m"), 4);
  EXPECT_EQ(In("parts[0].grid[1][2]"), 6);
}

TEST(FieldPath, WhatThisMessageDoesNotHaveIsNull) {
  EXPECT_TRUE(In("ranges_m[7]").is_null());
}

TEST(FieldPath, NamesTheWrongPartAndTheNearestOne) {
  EXPECT_EQ(
      ErrorOf("range_m[1]"),
      "p.outer_t: unknown field \"range_m\"; nearest: \"ranges_m\" (priamos type show outer_t lists all)");
  EXPECT_THAT(ErrorOf("parts[0].xm"), HasSubstr("p.inner_t: unknown field \"xm\""));
  EXPECT_THAT(ErrorOf("n.x"), HasSubstr("expected the end"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("expected a name"));
  EXPECT_THAT(ErrorOf("n."), HasSubstr("expected a name"));
}

TEST(FieldPath, ABadIndexIsAnsweredWithThoseThatThereAre) {
  EXPECT_EQ(ErrorOf("n[0]"), "field n[0]: bad index behind n: expected none, it is no array, got \"[0]\"");
  EXPECT_EQ(ErrorOf("parts[2]"), "field parts[2]: bad index behind parts: expected [0] to [1], got \"[2]\"");
  EXPECT_THAT(ErrorOf("parts[0].grid[1][3]"), HasSubstr("behind grid: expected [0] to [2], got \"[3]\""));
  EXPECT_THAT(ErrorOf("parts[0][0]"), HasSubstr("expected no more than 1 indices, got \"[0]\""));
  for (const std::string wrong : {"[one]", "[1", "[", "[-1]", "[0:3]"})
    EXPECT_THAT(ErrorOf("ranges_m" + wrong),
                HasSubstr("bad index behind ranges_m: expected a whole number in brackets like [0], got \"" +
                          wrong + "\""));
}

}  // namespace
}  // namespace priamos::cli
