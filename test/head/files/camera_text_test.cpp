#include "head/files/camera_text.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

namespace priamos::head {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ParseCameraText, TheNotationIsKnownByItsBeginning) {
  for (const char* text : {"a: 5\n", "%YAML:1.0\n---\na: 5\n", "<r><a>5</a></r>", "\n {\"a\": 5}",
                           "\xef\xbb\xbf"
                           "a: 5"}) {
    const auto dut = ParseCameraText(text);
    ASSERT_TRUE(dut) << text << dut.reason();
    EXPECT_EQ(dut->back().key, "a");
    EXPECT_THAT(dut->back().words, ElementsAre("5"));
  }
}

TEST(ParseCameraText, JsonListsOfListsAndOfObjects) {
  const auto dut = ParseCameraText(R"({"K": [[1, 2], [3.5, "x"]], "c": [{"k": 1}, {"k": 2}]})");
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->size(), 3u);
  EXPECT_THAT((*dut)[0].words, ElementsAre("1", "2", "3.5", "x"));
  EXPECT_EQ((*dut)[1].key, "c/0/k");
  EXPECT_EQ((*dut)[2].key, "c/1/k");
}

TEST(ParseCameraText, WhatIsNoTextIsRefused) {
  EXPECT_THAT(ParseCameraText("").reason(), HasSubstr("an empty file"));
  EXPECT_THAT(ParseCameraText(std::string_view("a\0b", 3)).reason(), HasSubstr("no text"));
  EXPECT_THAT(ParseCameraText("{\"a\": ").reason(), HasSubstr("JSON"));
  EXPECT_FALSE(ParseCameraText("{" + std::string(100000, '[')));
}

TEST(ParseCameraText, AnyTextGivesEntriesOrASentence) {
  rc::check([] {
    const auto characters =
        *rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab1.-: []{}<>/!#\"'\n\t,")));
    const std::string head = *rc::gen::element<std::string>("", "a: ", "<r>", "{\"a\":");
    const auto dut = ParseCameraText(head + characters);
    if (!dut) RC_ASSERT(dut.reason().find("expected ") != std::string::npos);
  });
}

}  // namespace
}  // namespace priamos::head
