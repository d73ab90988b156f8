#include "bus/parameters/parameter_json.hpp"

#include <gtest/gtest.h>

namespace priamos::bus {
namespace {

ParameterSheet Sheet() {
  return {ParameterTable(std::vector<Parameter>{
              {"drive.speed", "m/s", "fastest \"speed\"", 0.05, 1.5, LiveChange::kOnlyLower},
              {"gap", "m", "distance", 0, 1, LiveChange::kOnlyHigher},
              {"wait", "s", "time", 0, 60, LiveChange::kInRange}}),
          {0.6, 0.1 + 0.2, 5}};
}

TEST(ParameterJson, ComesBackAsItWas) {
  const auto read = ParameterSheetOf(ToJson(Sheet()));
  ASSERT_TRUE(read) << read.reason();
  EXPECT_EQ(read->table.Fingerprint(), Sheet().table.Fingerprint());
  EXPECT_EQ(read->values, Sheet().values);
  EXPECT_EQ(read->table.Find(1)->meaning, "fastest \"speed\"");
}

TEST(ParameterJson, WhatIsNoneOrOfAnotherVersionIsRefused) {
  EXPECT_FALSE(ParameterSheetOf(""));
  EXPECT_FALSE(ParameterSheetOf("The following argument was not expected: --print-parameters"));
  EXPECT_FALSE(ParameterSheetOf("[]"));
  EXPECT_FALSE(ParameterSheetOf(R"({"table": 5, "parameters": [{"name": 7}]})"));
  std::string other = ToJson(Sheet());
  other.replace(other.find("higher"), 6, "sooner");
  EXPECT_FALSE(ParameterSheetOf(other));
}

}  // namespace
}  // namespace priamos::bus
