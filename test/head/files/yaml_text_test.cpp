#include "head/files/yaml_text.hpp"

#include <gmock/gmock.h>

#include "test/head/files/entry_text.hpp"

namespace priamos::head {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string Told(std::string_view yaml) {
  return EntryText(ParseYaml(yaml));
}

TEST(ParseYaml, KeysWithinKeysAndListsOverLines) {
  EXPECT_EQ(Told("a: 1\nb:\n  c: [1, 2,\n      3]\n  d: two words\ne: !!opencv-matrix\n   f: \"x: y\"\ng: 7"),
            "a@1: 1\nb@2:\nb/c@3: 1 2 3\nb/d@5: two words\ne@6:\ne/f@7: x: y\ng@8: 7\n");
}

TEST(ParseYaml, ListsWithALineForEachElement) {
  EXPECT_EQ(Told("d:\n- 0.5\n- -1e-3 # small\nk:\n  - 'one'\n"), "d@1: 0.5 -1e-3\nk@4: one\n");
}

TEST(ParseYaml, ListsOfListsWithALineForEach) {
  EXPECT_EQ(Told("m:\n  - [1, 2,\n     3]\n  - [4]\nn: 5\n"), "m@1: 1 2 3 4\nn@5: 5\n");
}

TEST(ParseYaml, MapsInBraces) {
  EXPECT_EQ(Told("m: {rows: 1, data: [1, 2], in: {a:3}}\n"), "m/rows@1: 1\nm/data@1: 1 2\nm/in/a@1: 3\n");
}

TEST(ParseYaml, CommentsHeadsAndOtherDocumentsAreLeftOut) {
  EXPECT_EQ(Told("%YAML:1.0\n---\n# all\na: 1 # one\nb: \"#\"\r\n---\na: 2\n"), "a@4: 1\nb@5: #\n");
}

TEST(ParseYaml, WhatItCannotBeIsNamedWithItsLine) {
  EXPECT_THAT(Told("a: 1\nb\n"), StartsWith("2: expected \"key: value\", got \"b\""));
  EXPECT_THAT(Told("a: 1\na: 2\n"), StartsWith("2: a: expected it once, got it in line 1"));
  EXPECT_THAT(Told("a: 1\n\tb: 2\n"), HasSubstr("tabulator"));
  EXPECT_THAT(Told("a: [1, 2\nb: 3"), StartsWith("1: a: expected a list or map with its end"));
  EXPECT_THAT(Told("a: [1, 2]]\n"), HasSubstr("brackets in pairs"));
  EXPECT_THAT(Told("- 1\n"), HasSubstr("an element of a list"));
  EXPECT_THAT(Told("a: {b: {c: {d: {e: {f: {g: {h: {i: {j: 1}}}}}}}}}\n"), HasSubstr("fewer maps"));
}

TEST(ParseYaml, ALongListTakesNoTime) {
  std::string yaml = "a: [ 1\n";
  for (int i = 0; i < 100000; ++i) yaml += ", 1\n";
  EXPECT_EQ(ParseYaml(yaml + "]\n")->front().words.size(), 100001u);
}

}  // namespace
}  // namespace priamos::head
