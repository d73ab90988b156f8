#include "common/text/number_text.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace priamos {
namespace {

TEST(NumberOf, ANumberIsTheWholeText) {
  EXPECT_EQ(NumberOf<int>("-12"), -12);
  EXPECT_EQ(NumberOf<int>("010"), 10);
  EXPECT_EQ(NumberOf<double>("1.5e-3"), 1.5e-3);
  EXPECT_EQ(NumberOf<unsigned>("ff", 16), 255u);
}

TEST(NumberOf, AnythingElseIsNone) {
  for (const char* text : {"", " 1", "1 ", "+1", "1.5", "1x", "0x1", "one"})
    EXPECT_FALSE(NumberOf<int>(text)) << '"' << text << '"';
  for (const char* text : {"", " 1", "1 ", "+1", "1.5.", "0x1", "e3"})
    EXPECT_FALSE(NumberOf<double>(text)) << '"' << text << '"';
}

TEST(NumberOf, ANumberThatItsTypeCannotHoldIsNone) {
  EXPECT_EQ(NumberOf<std::uint16_t>("65535"), 65535);
  EXPECT_FALSE(NumberOf<std::uint16_t>("65536"));
  EXPECT_FALSE(NumberOf<std::uint16_t>("-1"));
  EXPECT_FALSE(NumberOf<double>("1e999"));
}

TEST(WithoutPlus, OnePlusBeforeANumberIsLeftOut) {
  EXPECT_EQ(WithoutPlus("+1.5"), "1.5");
  EXPECT_EQ(WithoutPlus("-1.5"), "-1.5");
  EXPECT_EQ(WithoutPlus("++1"), "+1");
  EXPECT_EQ(WithoutPlus(""), "");
}

}  // namespace
}  // namespace priamos
