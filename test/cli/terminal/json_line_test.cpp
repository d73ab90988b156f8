#include "cli/terminal/json_line.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

TEST(JsonLineTest, KeepsTheOrderAndTheTypes) {
  EXPECT_EQ(JsonLine({{"z", "text"}, {"a", 3}, {"m", 0.1}, {"k", true}, {"b", nullptr}}),
            R"({"z":"text","a":3,"m":0.1,"k":true,"b":null})");
}

TEST(JsonLineTest, OfNothingIsAnEmptyObject) {
  EXPECT_EQ(JsonLine({}), "{}");
}

TEST(JsonLineTest, EscapesText) {
  EXPECT_EQ(JsonLine({{"a \"b\"", "line\nline"}}), R"({"a \"b\"":"line\nline"})");
}

}  // namespace
}  // namespace priamos::cli
