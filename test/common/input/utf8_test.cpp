#include "common/input/utf8.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace priamos {
namespace {

TEST(CutUtf8, KeepsWhatFits) {
  EXPECT_EQ(CutUtf8("abc", 3), "abc");
  EXPECT_EQ(CutUtf8("", 0), "");
}

TEST(CutUtf8, EndsBeforeTheCharacterThatDoesNotFit) {
  EXPECT_EQ(CutUtf8("ab\u00f6", 3), "ab");
  EXPECT_EQ(CutUtf8("a\u20ac", 3), "a");
  EXPECT_EQ(CutUtf8("a\U0001f916b", 4), "a");
  EXPECT_EQ(CutUtf8("a\U0001f916b", 5), "a\U0001f916");
}

TEST(CutUtf8, WhatIsNoUtf8IsCutWhereItIsFull) {
  EXPECT_EQ(CutUtf8("\x80\x80\x80\x80\x80\x80\x80", 6).size(), 6u);
  EXPECT_EQ(CutUtf8("\x80\x80", 1).size(), 1u);
}

RC_GTEST_PROP(CutUtf8Property, IsTheBeginningAndLosesAtMostThreeBytes,
              (const std::string& text, std::uint8_t bytes)) {
  const auto cut = CutUtf8(text, bytes);
  RC_ASSERT(text.starts_with(cut));
  RC_ASSERT(cut.size() <= bytes);
  RC_ASSERT(cut.size() + 3 >= std::min<std::size_t>(text.size(), bytes));
}

}  // namespace
}  // namespace priamos
