#include "cli/supervise/console_piece.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

TEST(LastLines, AreWholeLinesAsFarAsTheyFit) {
  const ConsolePiece piece = LastLines("one\ntwo\nthree\n", 100, 11);
  EXPECT_EQ(piece.text, "two\nthree\n");
  EXPECT_EQ(piece.begin, 104);
  EXPECT_EQ(LastLines("one\ntwo\n", 0, 100).text, "one\ntwo\n");
  EXPECT_EQ(LastLines("two\nthree\n", 0, 6).text, "three\n") << "a line that begins there is whole";
}

TEST(LastLines, OfALongerLineAreItsEnd) {
  const ConsolePiece piece = LastLines("0123456789\n", 0, 4);
  EXPECT_EQ(piece.text, "789\n");
  EXPECT_EQ(piece.begin, 7);
  EXPECT_EQ(LastLines("ab\xc3\xa4", 0, 1).text, "") << "no half of a character";
}

TEST(LastLines, NeverSteerATerminalAndAreUtf8) {
  EXPECT_EQ(LastLines("a\x1b[31mb\r\n", 0, 100).text, "a?[31mb?\n");
  EXPECT_EQ(LastLines(std::string("a\0b\xff\n", 5), 0, 100).text, "a?b?\n");
  EXPECT_EQ(LastLines("gr\xc3\xbc\xc3\x9f dich\n", 0, 100).text, "gr\xc3\xbc\xc3\x9f dich\n");
}

class ConsolePieceTest : public testing::Test {
 protected:
  /// Everything, piece by piece from the end.
  std::string All(std::size_t most) const {
    std::string text;
    for (std::int64_t end = 0;;) {
      const auto piece = ReadConsolePiece(file_, end, most);
      text = piece->text + text;
      if (piece->begin == 0) return text;
      end = piece->begin;
    }
  }
  const TemporaryFolder folder_;
  const std::string file_ = (folder_ / "console.txt").string();
};

TEST_F(ConsolePieceTest, PiecesAreTheWholeConsole) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += std::string(static_cast<std::size_t>(i * 7 % 60), 'x') + "\n";
  std::ofstream(file_) << text;
  for (const std::size_t most : {10, 33, 150, 10000}) EXPECT_EQ(All(most), text) << most;
}

TEST_F(ConsolePieceTest, WhatIsNotThereHasNone) {
  EXPECT_FALSE(ReadConsolePiece(file_, 0, 150));
  std::ofstream(file_) << "one\n";
  EXPECT_EQ(ReadConsolePiece(file_, 1'000'000, 150)->text, "one\n") << "beyond its end: its end";
  std::ofstream{file_};
  EXPECT_EQ(ReadConsolePiece(file_, 0, 150)->text, "");
}

}  // namespace
}  // namespace priamos::cli
