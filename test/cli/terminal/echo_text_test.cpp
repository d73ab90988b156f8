#include "cli/terminal/echo_text.hpp"

#include <gtest/gtest.h>

#include "bus/own_types.hpp"

namespace priamos::cli {
namespace {

class EchoTextTest : public testing::Test {
 protected:
  FieldPath Field(const std::string& text) const { return {*schema_.Find("priamos.pose_t"), text}; }

  const bus::Schema schema_ = bus::OwnTypes();
  const bus::Json message_{{"x_m", 1.5}, {"y_m", -2}};
};

TEST_F(EchoTextTest, OfAWholeMessageIsIndentedForPeople) {
  EXPECT_EQ(EchoText(message_, {}, EchoForm::kForPeople), "{\n  \"x_m\": 1.5,\n  \"y_m\": -2\n}");
  EXPECT_EQ(EchoText(message_, {}, EchoForm::kOneLine), R"({"x_m":1.5,"y_m":-2})");
}

TEST_F(EchoTextTest, OfOneFieldIsItsValueForPeople) {
  EXPECT_EQ(EchoText(message_, {Field("x_m")}, EchoForm::kForPeople), "1.5");
  EXPECT_EQ(EchoText(message_, {Field("x_m")}, EchoForm::kOneLine), R"({"x_m":1.5})");
}

TEST_F(EchoTextTest, OfSomeFieldsKeepsTheirOrder) {
  EXPECT_EQ(EchoText(message_, {Field("y_m"), Field("x_m")}, EchoForm::kForPeople),
            R"({"y_m":-2,"x_m":1.5})");
}

}  // namespace
}  // namespace priamos::cli
