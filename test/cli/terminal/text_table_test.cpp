#include "cli/terminal/text_table.hpp"

#include <gmock/gmock.h>
#include <rapidcheck.h>

#include <sstream>

namespace priamos::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TextTable Fruit(int rows) {
  TextTable table({{"name", 9, true}, {"colour", 1, true}, {"weight", 5}});
  for (int i = 0; i < rows; ++i) table.Add({"apple", "red", std::to_string(100 + i)});
  return table;
}

TEST(TextTable, TextStandsLeftAndNumbersRight) {
  EXPECT_THAT(LinesOf(Fruit(1).Render()), ElementsAre("name   colour  weight", "apple  red        100"));
}

TEST(TextTable, ColumnsGoByWorth) {
  EXPECT_THAT(LinesOf(Fruit(1).Render({13, 9})), ElementsAre("name   weight", "apple     100"));
  EXPECT_THAT(LinesOf(Fruit(1).Render({12, 9})), ElementsAre("name", "apple"));
}

TEST(TextTable, WhatIsWiderThanTheTerminalIsCut) {
  EXPECT_THAT(LinesOf(Fruit(1).Render({3, 9})), ElementsAre("na…", "ap…"));
}

TEST(TextTable, RowsBeyondTheHeightAreCountedAndTheHeaderStays) {
  EXPECT_THAT(LinesOf(Fruit(9).Render({80, 10})), testing::SizeIs(10));
  const auto lines = LinesOf(Fruit(10).Render({80, 10}));
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_THAT(lines.front(), StartsWith("name"));
  EXPECT_EQ(lines.back(), "... 2 more");
  EXPECT_THAT(LinesOf(Fruit(5).Render({80, 2})), ElementsAre(StartsWith("name"), "... 5 more"));
  EXPECT_THAT(LinesOf(Fruit(5).Render({80, 0})), ElementsAre(StartsWith("name")));
}

TEST(TextTable, AnyTableFitsAnyTerminal) {
  EXPECT_TRUE(rc::check([] {
    std::vector<Column> columns;
    for (int i = *rc::gen::inRange(1, 10); i > 0; --i)
      columns.push_back({std::string(static_cast<std::size_t>(*rc::gen::inRange(0, 12)), 'T'),
                         *rc::gen::inRange(0, 100), *rc::gen::arbitrary<bool>()});
    TextTable table(columns);
    const int rows = *rc::gen::inRange(0, 60);
    for (int i = 0; i < rows; ++i) {
      std::vector<std::string> cells;
      for (std::size_t k = 0; k < columns.size(); ++k)
        cells.emplace_back(static_cast<std::size_t>(*rc::gen::inRange(0, 30)), 'x');
      table.Add(cells);
    }
    const ScreenSize size{*rc::gen::inRange(1, 120), *rc::gen::inRange(1, 60)};
    const auto lines = LinesOf(table.Render(size));
    RC_ASSERT(static_cast<int>(lines.size()) <= size.rows);
    for (const auto& line : lines) RC_ASSERT(Characters(line) <= size.columns);
    // Every row is shown or counted.
    if (static_cast<int>(lines.size()) == size.rows && size.rows > 1 && rows > size.rows - 1)
      RC_ASSERT(lines.back() ==
                Clipped("... " + std::to_string(rows - size.rows + 2) + " more", size.columns));
  }));
}

TEST(Clipped, CountsCharactersAndNotBytes) {
  EXPECT_EQ(Characters("Grüße"), 5);
  EXPECT_EQ(Clipped("Grüße", 5), "Grüße");
  EXPECT_EQ(Clipped("Grüße", 4), "Grü…");
  EXPECT_EQ(Clipped("Grüße", 0), "");
}

TEST(Wrapped, BreaksAtBlanksAndIndents) {
  EXPECT_THAT(LinesOf(Wrapped("  one two three four", 10, 4)),
              ElementsAre("  one two", "    three", "    four"));
  EXPECT_EQ(Wrapped("short", 80), "short\n");
  EXPECT_THAT(LinesOf(Wrapped("incomprehensibilities", 10)), ElementsAre("incompreh…"));
}

}  // namespace
}  // namespace priamos::cli
