#include "common/input/quoted.hpp"

#include <gtest/gtest.h>

namespace priamos {
namespace {

TEST(Quoted, KeepsWhatATerminalShows) {
  EXPECT_EQ(Quoted("POSE 3 µm"), "\"POSE 3 µm\"");
  EXPECT_EQ(Quoted(""), "\"\"");
}

TEST(Quoted, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(Quoted("A\n"), R"("A\n")");
  EXPECT_EQ(Quoted("\x1b[2J\r\t\x7f"), R"("\x1b[2J\r\t\x7f")");
  EXPECT_EQ(Quoted("\xc2\x9b[2J"), R"("\u009b[2J")") << "the same as one character";
  EXPECT_EQ(Quoted(std::string("a\0b", 3)), R"("a\x00b")");
  EXPECT_EQ(Quoted("\xc2"), "\"\xc2\"") << "half a character at the end";
}

TEST(Quoted, EndsWhereTheTextEnds) {
  EXPECT_EQ(Quoted(R"(a" \n)"), R"("a\" \\n")");
  EXPECT_EQ(Escaped(R"(a" \n)"), R"(a" \n)");
}

TEST(Quoted, ShowsTheBeginningOfALongText) {
  EXPECT_EQ(Quoted(std::string(80, 'x')), '"' + std::string(80, 'x') + '"');
  EXPECT_EQ(Quoted(std::string(10'000'000, 'x')), '"' + std::string(80, 'x') + "... (10000000 bytes)\"");
  EXPECT_EQ(Quoted(std::string(79, 'x') + "\u00b5m"), '"' + std::string(79, 'x') + "... (82 bytes)\"")
      << "no half of a character";
}

}  // namespace
}  // namespace priamos
