#include "common/outcome.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace priamos {
namespace {

Outcome<std::string> Read(bool there) {
  if (!there) return Refusal{"map.toml: there is no such file"};
  return std::string("text");
}

TEST(OutcomeTest, HasAValueOrTheReasonWhyThereIsNone) {
  const auto value = Read(true), none = Read(false);
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, "text");
  EXPECT_EQ(value->size(), 4u);
  EXPECT_EQ(value.reason(), "");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.reason(), "map.toml: there is no such file");
}

TEST(OutcomeTest, AValueThatCannotBeCopiedCanBeTakenOut) {
  Outcome<std::unique_ptr<int>> dut(std::make_unique<int>(3));
  const std::unique_ptr<int> taken = std::move(*dut);
  EXPECT_EQ(*taken, 3);
}

TEST(OutcomeTest, AnEmptyTextIsAValue) {
  EXPECT_TRUE(Outcome<std::string>(std::string()));
}

}  // namespace
}  // namespace priamos
