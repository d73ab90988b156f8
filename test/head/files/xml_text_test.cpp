#include "head/files/xml_text.hpp"

#include <gmock/gmock.h>

#include "test/head/files/entry_text.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string Told(std::string_view xml) {
  return EntryText(ParseXml(xml));
}

TEST(ParseXml, ElementsWithinElements) {
  EXPECT_EQ(
      Told("<?xml version=\"1.0\"?>\n<root>\n<a>1 2\n 3</a>\n<b type=\"x\"><c>4</c><c/></b>\n</root>\n"),
      "@2:\na@3: 1 2 3\nb@5:\nb/c@5: 4\nb/c#2@5:\n");
}

TEST(ParseXml, CommentsAreLeftOut) {
  EXPECT_EQ(Told("<!-- <a>\n -->\n<r><!--1-->2</r>"), "@3: 2\n");
}

TEST(ParseXml, WhatItCannotBeIsNamedWithItsLine) {
  EXPECT_EQ(Told("<r>\n<a>\n</b></r>"), "3: expected </a>, got </b>");
  EXPECT_EQ(Told("<r>\n<a>"), "2: expected </a>, got the end of the file");
  EXPECT_EQ(Told("<r>\n<a"), "2: expected the end of an element (>), got the end of the file");
  EXPECT_EQ(Told("<r></r></r>"), "1: expected an element, got </r>");
  EXPECT_EQ(Told("<r></r><q></q>"), "1: expected one root, got <q> behind it");
  EXPECT_THAT(Told("text <r/>"), HasSubstr("text outside"));
  EXPECT_THAT(Told("<!ENTITY a \"b\"><r/>"), HasSubstr("a declaration <!"));
  EXPECT_THAT(Told("<r><></r>"), HasSubstr("the name of an element"));
  std::string deep;
  for (int i = 0; i < 20; ++i) deep += "<a>";
  EXPECT_THAT(Told(deep), HasSubstr("fewer elements"));
}

}  // namespace
}  // namespace priamos::head
