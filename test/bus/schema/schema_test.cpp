#include "bus/schema/schema.hpp"

#include <gmock/gmock.h>

#include <tuple>

#include "bus/type_files.hpp"
#include "foreign/deep/empty_t.hpp"
#include "foreign/deep/everything_t.hpp"
#include "foreign/deep/tree_t.hpp"
#include "foreign/point_t.hpp"
#include "lcmtypes/channels.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "no_package_inner_t.hpp"
#include "no_package_t.hpp"
#include "priamos/landmark_edge_t.hpp"
#include "priamos/link_channel_t.hpp"
#include "priamos/path_point_t.hpp"

namespace priamos::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kForeign = PRIAMOS_SOURCE_DIR "/test/bus/schema/foreign";

Schema FromText(const std::string& text) {
  return Schema({{"t.lcm", text}});
}

std::string ErrorOf(const std::string& text) {
  try {
    FromText(text);
  } catch (const SchemaError& error) {
    return error.what();
  }
  return "no error";
}

template <class T>
void ExpectFingerprint(const Schema& schema) {
  const Struct* type = schema.Find(static_cast<std::uint64_t>(T::getHash()));
  ASSERT_NE(type, nullptr) << T::getTypeName();
  EXPECT_EQ(type->name, T::getTypeName());
}

TEST(Schema, FingerprintOfEveryMessageEqualsLcmGens) {
  const Schema dut = Schema::FromTexts(EmbeddedTypes());
  std::apply(
      [&](const auto&... channel) {
        (ExpectFingerprint<typename std::decay_t<decltype(channel)>::Message>(dut), ...);
      },
      channels::kAll);
  ExpectFingerprint<landmark_edge_t>(dut);
  ExpectFingerprint<link_channel_t>(dut);
  ExpectFingerprint<path_point_t>(dut);
  EXPECT_EQ(dut.All().size(), EmbeddedTypes().size());
}

TEST(Schema, FingerprintOfForeignTypesEqualsLcmGens) {
  const Schema dut(ReadTypeFiles(kForeign));
  ExpectFingerprint<foreign::deep::everything_t>(dut);
  ExpectFingerprint<foreign::deep::tree_t>(dut);
  ExpectFingerprint<foreign::deep::empty_t>(dut);
  ExpectFingerprint<foreign::point_t>(dut);
  ExpectFingerprint<no_package_t>(dut);
  ExpectFingerprint<no_package_inner_t>(dut);
}

TEST(Schema, FingerprintOfMutualRecursionEqualsLcmGens) {
  // lcm-gen's C++ for such types does not compile; the numbers are from its Python code (lcm-gen -p).
  const Schema dut = FromText(
      "package mutual; struct ping_t { int32_t n; pong_t pongs[n]; ping_t pings[n]; }"
      "struct pong_t { string s; int8_t m; ping_t pings[m]; }");
  EXPECT_EQ(dut.Find("ping_t")->fingerprint, 0xa878bee3f6e5bcd1u);
  EXPECT_EQ(dut.Find("pong_t")->fingerprint, 0xe3d46515d7d47b2au);
}

TEST(Schema, FindsByFullNameAndByUniqueShortName) {
  const Schema dut =
      FromText("package a; struct x {} struct y { int8_t q; } package b; struct x { int8_t r; }");
  EXPECT_EQ(dut.Find("a.x")->full_name, "a.x");
  EXPECT_EQ(dut.Find("y")->full_name, "a.y");
  EXPECT_EQ(dut.Find("x"), nullptr);
  EXPECT_EQ(dut.Find("z"), nullptr);
  EXPECT_EQ(dut.Find(std::uint64_t{1}), nullptr);
}

TEST(Schema, ResolvesNestedTypes) {
  const Schema dut = FromText("struct a { b x; } struct b { int8_t n; a y[n]; }");
  EXPECT_EQ(dut.Find("a")->fields[0].type, dut.Find("b"));
  EXPECT_EQ(dut.Find("b")->fields[1].type, dut.Find("a"));
}

TEST(Schema, FieldsKeepTheirAddressWhenTheSchemaMoves) {
  Schema first = FromText("struct a { b x; } struct b { int8_t n; }");
  const Struct* b = first.Find("b");
  const Schema dut = std::move(first);
  EXPECT_EQ(dut.Find("a")->fields[0].type, b);
  EXPECT_EQ(dut.Find("b"), b);
}

TEST(Schema, RefusesUnknownAndDoubleTypes) {
  EXPECT_EQ(ErrorOf("package p; struct a {\n b x; }"),
            "t.lcm:2: p.a.x: expected a type that is defined, got p.b");
  EXPECT_EQ(ErrorOf("struct a { uint8_t x; }"), "t.lcm:1: a.x: expected a type that is defined, got uint8_t");
  EXPECT_EQ(ErrorOf("struct a { int8_t x; }\nstruct a { int8_t y; }"),
            "t.lcm:2: expected one definition of a, got another one than in t.lcm:1");
}

TEST(Schema, RefusesNestingThatIsTooDeep) {
  std::string text;
  for (int i = 0; i < 300; ++i) {
    text += "struct t" + std::to_string(i) + " { t" + std::to_string(i + 1) + " x; }\n";
  }
  EXPECT_THAT(ErrorOf(text + "struct t300 { }"), HasSubstr("nest too deeply"));
}

TEST(Schema, ManyTypesThatShareTypesAreHashedOnce) {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    const std::string next = std::to_string(i + 1);
    text.append("struct t" + std::to_string(i))
        .append(" { t" + next)
        .append(" a; t" + next)
        .append(" b; }\n");
  }
  EXPECT_EQ(ErrorOf(text + "struct t100 { }"), "no error");  // 2^100 paths
}

TEST(Schema, TakesWhatItCanWhenAskedTo) {
  std::vector<std::string> problems;
  const Schema dut({{"a.lcm", "struct a { missing_t x; } struct uses_a { a y; } struct good { int8_t q; }"},
                    {"b.lcm", "enum e { A }"}},
                   problems);
  EXPECT_NE(dut.Find("good"), nullptr);
  EXPECT_EQ(dut.All().size(), 1u);
  EXPECT_THAT(problems, ElementsAre("b.lcm:1: enum types are not supported, use constants in a struct",
                                    "a.lcm:1: a.x: expected a type that is defined, got missing_t",
                                    "a.lcm:1: uses_a.y: expected a type that can be used, got a"));
  for (const char* name : {"a", "uses_a", "e"}) EXPECT_TRUE(dut.Refused(name)) << name;
  for (const char* name : {"good", "missing_t", ""}) EXPECT_FALSE(dut.Refused(name)) << name;
}

TEST(Schema, TheSameDefinitionInTwoPlacesIsOne) {
  EXPECT_EQ(ErrorOf("struct a { const int8_t C = 1; int8_t n; double x[n][3]; }\n"
                    "struct a { const int8_t C = 1; int8_t n; // how many\n double x[n][3]; }"),
            "no error");
}

TEST(Schema, OfDifferentDefinitionsNoneIsTaken) {
  for (const char* other : {"int8_t n; double x[n][4];", "int8_t n; float x[n][3];", "int8_t n;",
                            "const int8_t C = 1; int8_t n; double x[n][3];",
                            "int8_t n; double x[n][3]; /* [m] @range 0,1 @step 1: packed */"}) {
    std::vector<std::string> problems;
    const Schema dut({{"a.lcm", "package p; struct s { int8_t n; double x[n][3]; } struct good { }"},
                      {"b.lcm", "package p; struct s { " + std::string(other) + " } struct uses { s x; }"}},
                     problems);
    EXPECT_EQ(dut.Find("s"), nullptr);
    EXPECT_TRUE(dut.Refused("p.s"));
    EXPECT_NE(dut.Find("good"), nullptr);
    EXPECT_THAT(problems,
                ElementsAre("b.lcm:1: expected one definition of p.s, got another one than in a.lcm:1",
                            "b.lcm:1: p.uses.x: expected a type that can be used, got p.s"))
        << other;
  }
}

TEST(Schema, FingerprintOfASizeThatIsAConstantIsThatOfItsValue) {
  EXPECT_EQ(FromText("struct c { const int32_t N = 0x3, M = 2; double a[N][M]; string s[N]; }")
                .Find("c")
                ->fingerprint,
            FromText("struct c { double a[0x3][2]; string s[0x3]; }").Find("c")->fingerprint);
}

TEST(Schema, AChainOfManyTypesIsRefusedSoonWithoutACrash) {
  const auto chain = [](const std::string& end) {
    std::string text;
    for (int i = 0; i < 5000; ++i)
      text += "struct t" + std::to_string(i) + " { t" + std::to_string(i + 1) + " x; }\n";
    return text + end;
  };
  std::vector<std::string> problems;
  const Schema deep({{"t.lcm", chain("struct t5000 { int8_t x; }")}}, problems);
  EXPECT_EQ(problems.size() + deep.All().size(), 5001u);
  EXPECT_NE(deep.Find("t5000"), nullptr);
  problems.clear();
  const Schema open({{"t.lcm", chain("")}}, problems);
  EXPECT_EQ(problems.size(), 5000u);
  EXPECT_TRUE(open.All().empty());
}

TEST(Schema, FingerprintOfReadsBigEndian) {
  const std::uint8_t bytes[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(FingerprintOf(bytes, 9), 0x0102030405060708u);
  EXPECT_EQ(FingerprintOf(bytes, 7), 0u);
}

std::optional<std::size_t> BoundOf(const std::string& text) {
  return MaxEncodedSize(*FromText(text).Find("s"));
}

TEST(MaxEncodedSize, AddsUpFixedFields) {
  EXPECT_EQ(BoundOf("struct s { int8_t a; double b[3][2]; t c; } struct t { int16_t d; }"), 8u + 1 + 48 + 2);
  EXPECT_EQ(BoundOf("struct s { }"), 8u);
}

TEST(MaxEncodedSize, UsesTheSmallerOfMaxAndRangeOfTheCount) {
  EXPECT_EQ(BoundOf("struct s { int8_t n; // [-] @range 0,5 @step 1: n\n double a[n]; // [-] @max 7: a\n }"),
            8u + 1 + 40);
  EXPECT_EQ(BoundOf("struct s { int8_t n; // [-] @range 0,9 @step 1: n\n double a[n]; // [-] @max 7: a\n }"),
            8u + 1 + 56);
  EXPECT_EQ(BoundOf("struct s { int8_t n; // [-] @range 0,9 @step 1: n\n double a[n]; }"), 8u + 1 + 72);
}

TEST(MaxEncodedSize, CountsStringsWithLengthAndTerminator) {
  EXPECT_EQ(BoundOf("struct s { string a; // [ascii] @max 10: a\n }"), 8u + 4 + 10 + 1);
  EXPECT_EQ(BoundOf("struct s { int8_t n; string a[n]; // [ascii] @max 3,10: a\n }"), 8u + 1 + 3 * 15);
}

TEST(MaxEncodedSize, IsUnknownWithoutBounds) {
  EXPECT_EQ(BoundOf("struct s { string a; }"), std::nullopt);
  EXPECT_EQ(BoundOf("struct s { int8_t n; double a[n]; }"), std::nullopt);
  EXPECT_EQ(BoundOf("struct s { int8_t n; s a[n]; // [-] @max 3: a\n }"), std::nullopt);
  EXPECT_EQ(BoundOf("struct s { int8_t n; string a[n]; // [ascii] @max 3: length only\n }"), std::nullopt);
}

TEST(MaxEncodedSize, DoesNotOverflow) {
  EXPECT_GT(*BoundOf("struct s { int16_t a[2147483647][2147483647]; }"), std::size_t{1} << 62);
  EXPECT_EQ(BoundOf("struct s { double a[2147483647][2147483647][2147483647]; }"), std::nullopt);
}

}  // namespace
}  // namespace priamos::bus
