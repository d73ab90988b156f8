#include "bus/schema/lcm_parser.hpp"

#include <gmock/gmock.h>

namespace priamos::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;

Struct ParseOne(std::string_view text) {
  std::vector<Struct> all = ParseLcm("t.lcm", text);
  EXPECT_EQ(all.size(), 1u);
  return all.at(0);
}

std::string ErrorOf(std::string_view text) {
  try {
    ParseLcm("t.lcm", text);
  } catch (const SchemaError& error) {
    return error.what();
  }
  return "no error";
}

TEST(LcmParser, ReadsPackageStructAndFields) {
  const Struct dut =
      ParseOne("package a.b;\n\n// About it.\nstruct c_t {\n  int8_t x;\n  d_t y[x][3];\n e.f_t z; }");
  EXPECT_EQ(dut.full_name, "a.b.c_t");
  EXPECT_EQ(dut.doc, "About it.");
  EXPECT_EQ(dut.line, 4);
  ASSERT_EQ(dut.fields.size(), 3u);
  EXPECT_EQ(dut.fields[0].kind, Kind::kInt8);
  EXPECT_EQ(dut.fields[0].line, 5);
  EXPECT_EQ(dut.fields[1].kind, Kind::kStruct);
  EXPECT_EQ(dut.fields[1].type_name, "a.b.d_t");
  ASSERT_EQ(dut.fields[1].dims.size(), 2u);
  EXPECT_TRUE(dut.fields[1].dims[0].variable);
  EXPECT_EQ(dut.fields[1].dims[0].count_field, 0u);
  EXPECT_FALSE(dut.fields[1].dims[1].variable);
  EXPECT_EQ(dut.fields[1].dims[1].size, 3);
  EXPECT_EQ(dut.fields[2].type_name, "e.f_t");
}

TEST(LcmParser, ReadsEveryPrimitive) {
  const Struct dut = ParseOne(
      "struct p { int8_t a; int16_t b; int32_t c; int64_t d; float e; double f; boolean g; byte h; string i; "
      "}");
  std::vector<Kind> kinds;
  for (const Field& field : dut.fields) kinds.push_back(field.kind);
  EXPECT_THAT(kinds, ElementsAre(Kind::kInt8, Kind::kInt16, Kind::kInt32, Kind::kInt64, Kind::kFloat,
                                 Kind::kDouble, Kind::kBoolean, Kind::kByte, Kind::kString));
}

TEST(LcmParser, ReadsSeveralStructsAndPackagesOfOneFile) {
  const auto all = ParseLcm("t.lcm", "struct a { b x; } package p; struct b { a y; };");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].fields[0].type_name, "b");
  EXPECT_EQ(all[1].full_name, "p.b");
  EXPECT_EQ(all[1].fields[0].type_name, "p.a");
}

TEST(LcmParser, ReadsConstants) {
  const Struct dut = ParseOne(
      "struct c { const int8_t A = -128, B = 0x7F; const int64_t C = -9223372036854775808; const float D = "
      "-2.5e1;}");
  ASSERT_EQ(dut.constants.size(), 4u);
  EXPECT_EQ(dut.constants[0].value.integer, -128);
  EXPECT_EQ(dut.constants[1].value.integer, 127);
  EXPECT_EQ(dut.constants[2].value.integer, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(dut.constants[3].value.value, -25.0);
}

TEST(LcmParser, ReadsSizesAsTheCompilerOfTheGeneratedCodeDoes) {
  const Struct dut = ParseOne("struct s { byte a[0x10][010][9]; }");
  EXPECT_EQ(dut.fields[0].dims[0].size, 16);
  EXPECT_EQ(dut.fields[0].dims[1].size, 8);
  EXPECT_EQ(dut.fields[0].dims[2].size, 9);
  EXPECT_EQ(dut.fields[0].dims[0].text, "0x10");
}

TEST(LcmParser, ReadsAnnotation) {
  const Struct dut =
      ParseOne("struct s { double x_m; // [m] @frame map @range -1.5,2 @step 0.01 @invalid -9: how far\n }");
  const Annotation& a = dut.fields[0].annotation;
  EXPECT_EQ(a.problem, "");
  EXPECT_EQ(a.unit, "m");
  EXPECT_EQ(a.frame, "map");
  EXPECT_EQ(a.min->value, -1.5);
  EXPECT_EQ(a.min->integer, std::nullopt);
  EXPECT_EQ(a.max->integer, 2);
  EXPECT_EQ(a.step->value, 0.01);
  EXPECT_EQ(a.invalid->integer, -9);
  EXPECT_EQ(a.meaning, "how far");
}

TEST(LcmParser, RefuseIsATagWithoutValueInAnyPlace) {
  const Struct dut = ParseOne(
      "struct s { int8_t a; // [-] @range 0,5 @refuse: mode\n"
      "int8_t b; // [-] @refuse @range 0,5 @step 1\n"
      "int8_t c; // [-] @refuse @range 0,5 @refuse: twice\n"
      "int8_t d; // [-] @range 0,5: mode\n }");
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(dut.fields[i].annotation.problem, "");
    EXPECT_TRUE(dut.fields[i].annotation.refuse);
    EXPECT_EQ(dut.fields[i].annotation.max->integer, 5);
  }
  EXPECT_EQ(dut.fields[0].annotation.meaning, "mode");
  EXPECT_EQ(dut.fields[2].annotation.problem, "@refuse is there twice");
  EXPECT_FALSE(dut.fields[3].annotation.refuse);
}

TEST(LcmParser, AnEnumerationIsAnIntegerWhoseMeaningNamesAConstantOfItsMessage) {
  const Struct dut = ParseOne(
      "struct s { const int8_t IDLE = 0, LIMIT_NONE = 0, LIMIT_SONAR = 1;\n"
      "int8_t mode; // [-] @range 0,5: IDLE, ...\n"
      "int8_t limit; // [-] @range 0,5: what limits it, LIMIT_...\n"
      "int8_t idle; // [-] @range 0,5: how often IDLES or idle\n"
      "int8_t other; // [-] @range 0,5: constant of other_t\n"
      "double part; // [-] @range 0,1 @step 0.1: part of the time in IDLE\n"
      "int64_t utime; // [us] @age 1000 @step 1: since IDLE\n"
      "int8_t named_limit_; // [-] @range 0,5: limit_\n }");
  std::vector<std::string> names;
  for (const Field& field : dut.fields)
    if (dut.IsEnumeration(field)) names.push_back(field.name);
  EXPECT_THAT(names, ElementsAre("mode", "limit"));
}

TEST(LcmParser, ReadsAgeAndSizes) {
  const Struct dut = ParseOne(
      "struct s { int64_t utime; // [us] @age 5000000 @step 100: when\n"
      "int8_t n; string s[n]; // [ascii] @max 4,16: who: a, b\n }");
  EXPECT_EQ(dut.fields[0].annotation.age_us, 5000000);
  EXPECT_THAT(dut.fields[2].annotation.sizes, ElementsAre(4, 16));
  EXPECT_EQ(dut.fields[2].annotation.meaning, "who: a, b");
}

TEST(LcmParser, CommentBelongsToTheFieldBeforeItOnTheLineOrBelowItOnItsOwnLine) {
  const Struct dut = ParseOne(
      "struct s {\n"
      "  // heading of a section\n"
      "\n"
      "  // leads a\n"
      "  int8_t a;\n"
      "  int8_t b;  // [-] @range 0,1: trails b\n"
      "             // and goes on\n"
      "  /* leads\n"
      "   * c */\n"
      "  int8_t c, d;  /// trails both\n"
      "  int8_t e,  // only e\n"
      "         f;  // only f\n"
      "  int8_t g;\n"
      "}  // behind\n");
  const auto comment = [&](int i) { return dut.fields[static_cast<std::size_t>(i)].comment; };
  EXPECT_EQ(comment(0), "leads a");
  EXPECT_EQ(comment(1), "[-] @range 0,1: trails b and goes on");
  EXPECT_EQ(dut.fields[1].annotation.meaning, "trails b and goes on");
  EXPECT_EQ(comment(2), "leads c trails both");
  EXPECT_EQ(comment(3), "leads c trails both");
  EXPECT_EQ(comment(4), "only e");
  EXPECT_EQ(comment(5), "only f");
  EXPECT_EQ(comment(6), "");
}

TEST(LcmParser, AnnotationMayLeadTheField) {
  const Struct dut =
      ParseOne("struct s {\n  // [m] @range 0,1 @step 1: how far\n  double x_m;  // remark\n}");
  EXPECT_EQ(dut.fields[0].annotation.unit, "m");
}

TEST(LcmParser, OtherPeoplesCommentIsTheMeaning) {
  const Struct dut = ParseOne("struct s { int8_t a; // metres @ noon: roughly\n }");
  EXPECT_EQ(dut.fields[0].annotation.unit, "");
  EXPECT_EQ(dut.fields[0].annotation.problem, "");
  EXPECT_EQ(dut.fields[0].annotation.meaning, "metres @ noon: roughly");
}

TEST(LcmParser, UnreadableAnnotationIsNoError) {
  const auto problem = [](std::string comment) {
    return ParseOne("struct s { int8_t a; // " + comment + "\n }").fields[0].annotation.problem;
  };
  EXPECT_EQ(problem("[0..3] which"), "expected a @tag or a colon before the meaning");
  EXPECT_EQ(problem("[m @range 0,1: x"), "the bracket of the unit is not closed");
  EXPECT_EQ(problem("[] x"), "the unit is empty, [-] means a plain number");
  EXPECT_EQ(problem("[m] @range 0: x"), "@range expects two numbers A,B, got '0'");
  EXPECT_EQ(problem("[m] @range 1,0: x"), "the second number of @range is not above the first");
  EXPECT_EQ(problem("[m] @range 0,nan: x"), "@range expects two numbers A,B, got '0,nan'");
  EXPECT_EQ(problem("[m] @step 0: x"), "@step is not above 0");
  EXPECT_EQ(problem("[m] @step 1 @step 2: x"), "@step expects one number, got '2'");
  EXPECT_EQ(problem("[m] @max 0: x"), "@max expects whole numbers from 1 to 65535, got '0'");
  EXPECT_EQ(problem("[us] @age 1.5: x"), "@age expects microseconds, a whole number above 0, got '1.5'");
  EXPECT_EQ(problem("[m] @colour red: x"), "the tag @colour is not known");
  EXPECT_EQ(problem("[us] @age 10 @range 0,1: x"), "a time stamp has @age or @range, not both");
}

TEST(LcmParser, RefusesWithFileLineAndASentence) {
  EXPECT_EQ(ErrorOf("struct s {\n enum e {A} x; }"),
            "t.lcm:2: expected a field or '}', got 'enum': LCM has no types within types");
  EXPECT_EQ(ErrorOf("enum e_t { A }"), "t.lcm:1: enum types are not supported, use constants in a struct");
  EXPECT_EQ(ErrorOf("struct s { int8_t a;\n int8_t a; }"), "t.lcm:2: the name 'a' is used twice in s");
  EXPECT_EQ(ErrorOf("struct s { const int8_t a = 1; int8_t a; }"),
            "t.lcm:1: the name 'a' is used twice in s");
  EXPECT_EQ(ErrorOf("struct s { int8_t a[n]; int8_t n; }"),
            "t.lcm:1: the array size 'n' is no field declared before the array");
  EXPECT_EQ(ErrorOf("struct s { byte n; int8_t a[n]; }"),
            "t.lcm:1: the array size 'n' is not a single integer field");
  EXPECT_EQ(ErrorOf("struct s { int8_t n[2]; int8_t a[n]; }"),
            "t.lcm:1: the array size 'n' is not a single integer field");
  EXPECT_EQ(ErrorOf("struct s { int8_t a[0]; }"),
            "t.lcm:1: the array size '0' is not a whole number above 0");
  EXPECT_EQ(ErrorOf("struct s { int8_t a[]; }"), "t.lcm:1: expected the size of the array, got ']'");
  EXPECT_EQ(ErrorOf("struct s { const int8_t A = 200; }"), "t.lcm:1: '200' is no int8_t");
  EXPECT_EQ(ErrorOf("struct s { const string A = 1; }"),
            "t.lcm:1: a constant cannot be of type string, only integers, float and double");
  EXPECT_EQ(ErrorOf("struct int8_t { }"), "t.lcm:1: 'int8_t' is a primitive type of LCM");
  EXPECT_EQ(ErrorOf("struct s { int8_t a;"),
            "t.lcm:1: expected the type of a field, got the end of the file");
  EXPECT_EQ(ErrorOf("\n/* open"), "t.lcm:2: the comment is not closed");
  EXPECT_EQ(ErrorOf("# what"), "t.lcm:1: this character (code 35) has no place in a .lcm file");
  EXPECT_THAT(ErrorOf("struct s { int8_t 3a; }"),
              StartsWith("t.lcm:1: expected the name of the field, got '3a'"));
}

TEST(LcmParser, ASizeMayBeAConstantOfTheSameStruct) {
  const Struct dut = ParseOne("struct s { const int32_t N = 0x3, M = 2; string a[N][M]; }");
  ASSERT_EQ(dut.fields[0].dims.size(), 2u);
  EXPECT_FALSE(dut.fields[0].dims[0].variable);
  EXPECT_EQ(dut.fields[0].dims[0].size, 3);
  EXPECT_EQ(dut.fields[0].dims[0].text, "0x3") << "as if it stood there";
  EXPECT_EQ(ErrorOf("struct s { const int8_t N = 0; int8_t a[N]; }"),
            "t.lcm:1: the array size 'N' is 0, not a whole number above 0");
  EXPECT_EQ(ErrorOf("struct s { const double N = 2; int8_t a[N]; }"),
            "t.lcm:1: the array size 'N' is 2, not a whole number above 0");
}

TEST(LcmParser, CommentsMayStandBetweenAnyTwoWords) {
  const Struct dut = ParseOne(
      "/* of\n the file */\npackage // a\n p // b\n; /// the type\nstruct // c\n s_t // d\n{\n//\n"
      "int8_t // e\n n // f\n /**/ ; const // g\n int8_t // h\n C // i\n = // j\n 5 // k\n ;\n"
      "double a[ // l\n n // m\n ] // n\n ;\n}");
  EXPECT_EQ(dut.full_name, "p.s_t");
  ASSERT_EQ(dut.fields.size(), 2u);
  EXPECT_EQ(dut.fields[1].dims[0].text, "n");
  EXPECT_EQ(dut.constants[0].value.integer, 5);
}

TEST(LcmParser, AByteOrderMarkAndDosLinesChangeNothing) {
  const Struct dut =
      ParseOne("\xEF\xBB\xBFpackage p;\r\n// About it.\r\nstruct s {\r\n\tint8_t a; // one\r\n\f}\r\n");
  EXPECT_EQ(dut.full_name, "p.s");
  EXPECT_EQ(dut.line, 3);
  EXPECT_EQ(dut.doc, "About it.");
  EXPECT_EQ(dut.fields[0].comment, "one");
  EXPECT_EQ(ErrorOf("\xFF\xFEs"), "t.lcm:1: this character (code 255) has no place in a .lcm file");
}

TEST(LcmParser, WordsOfTheLanguageAreNamesWhereANameIsExpected) {
  const Struct dut =
      ParseOne("struct package { int8_t struct; int16_t const2, enum; double int8_t; string class; }");
  EXPECT_EQ(dut.name, "package");
  EXPECT_EQ(dut.fields.size(), 5u);
  EXPECT_EQ(ErrorOf("struct s { struct t { int8_t a; } b; }"),
            "t.lcm:1: expected a field or '}', got 'struct': LCM has no types within types");
  EXPECT_EQ(ErrorOf("struct s { const struct; }"),
            "t.lcm:1: a constant cannot be of type struct, only integers, float and double");
  EXPECT_EQ(ErrorOf("import x;"), "t.lcm:1: expected 'package' or 'struct', got 'import'");
}

TEST(LcmParser, MoreDimensionsThanAnybodyWritesAreRefused) {
  const auto text = [](int n) {
    std::string sizes;
    for (int i = 0; i < n; ++i) sizes += "[1]";
    return "struct s { int8_t a" + sizes + "; }";
  };
  EXPECT_EQ(ErrorOf(text(32)), "no error");
  EXPECT_EQ(ErrorOf(text(100000)), "t.lcm:1: expected at most 32 dimensions of an array, got more");
}

std::vector<std::string> ProblemsOf(std::string_view text, std::vector<std::string>& names) {
  std::vector<TypeProblem> problems;
  for (const Struct& type : ParseLcm("t.lcm", text, problems)) names.push_back(type.full_name);
  std::vector<std::string> lines;
  for (const TypeProblem& problem : problems) lines.push_back(problem.type + " " + problem.sentence);
  return lines;
}

TEST(LcmParser, ATypeThatCannotBeReadDoesNotHinderTheOthers) {
  std::vector<std::string> names;
  EXPECT_THAT(ProblemsOf("package p;\nstruct a { int8_t 3; }\nstruct b { int8_t x; }\n"
                         "struct c { # ? }\nenum d { A, B }\nstruct e { int8_t x;\nstruct f { }\n"
                         "package q; struct g { int8_t x; }\nstruct h { int8_t",
                         names),
              ElementsAre("p.a t.lcm:2: expected the name of the field, got '3'",
                          "p.c t.lcm:4: this character (code 35) has no place in a .lcm file",
                          "p.d t.lcm:5: enum types are not supported, use constants in a struct",
                          "p.e t.lcm:7: expected a field or '}', got 'struct': LCM has no types within types",
                          "q.h t.lcm:9: expected the name of the field, got the end of the file"));
  EXPECT_THAT(names, ElementsAre("p.b", "p.f", "q.g"));
}

TEST(LcmParser, WhatIsNoTypeAtAllIsNamedOncePerFile) {
  std::vector<std::string> names;
  EXPECT_THAT(ProblemsOf("import a; ? import b; } x } struct s { } y }", names),
              ElementsAre(" t.lcm:1: expected 'package' or 'struct', got 'import'"));
  EXPECT_THAT(names, ElementsAre("s"));
}

TEST(LcmParser, EmptyTextHasNoTypes) {
  EXPECT_TRUE(ParseLcm("t.lcm", "").empty());
  EXPECT_TRUE(ParseLcm("t.lcm", "// nothing\n/* here */").empty());
}

}  // namespace
}  // namespace priamos::bus
