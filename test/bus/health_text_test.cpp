#include "bus/health_text.hpp"

#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "bus/schema/schema.hpp"

namespace priamos::bus {
namespace {

TEST(FitHealthText, IsAsLongAsTheTypeAllows) {
  const Schema schema = OwnTypes();
  const Field& field = schema.Find("health_t")->fields.back();
  ASSERT_EQ(field.name, "text");
  EXPECT_EQ(static_cast<std::int64_t>(FitHealthText(std::string(1000, 'x')).size()), MaxTextLength(field));
}

TEST(FitHealthText, EndsWithAWholeCharacter) {
  EXPECT_EQ(FitHealthText(std::string(93, 'x') + "\u00f6"), std::string(93, 'x'));
}

}  // namespace
}  // namespace priamos::bus
