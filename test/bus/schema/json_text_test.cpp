#include "bus/schema/json_text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

// The same bytes as bus/python: test/bus/python/python_bus_test.cpp.

namespace priamos::bus {
namespace {

TEST(JsonText, PlacesThePointAsPythonDoes) {
  const std::pair<double, const char*> numbers[] = {{0, "0.0"},
                                                    {-0.0, "-0.0"},
                                                    {1, "1.0"},
                                                    {-12.5, "-12.5"},
                                                    {1e15, "1000000000000000.0"},
                                                    {1234567890123456, "1234567890123456.0"},
                                                    {1e16, "1e+16"},
                                                    {1.5e300, "1.5e+300"},
                                                    {0.1, "0.1"},
                                                    {0.0001, "0.0001"},
                                                    {0.00001, "1e-05"},
                                                    {5e-324, "5e-324"},
                                                    {1e22, "1e+22"},
                                                    {0.1 + 0.2, "0.30000000000000004"},
                                                    {1.7976931348623157e308, "1.7976931348623157e+308"}};
  for (const auto& [number, text] : numbers) EXPECT_EQ(JsonText(number), text);
}

TEST(JsonText, WritesEverythingElseAsItIs) {
  const std::string text = R"({"n":-9223372036854775808,"u":18446744073709551615,"t":"a\"\\\n\u0001ä",)"
                           R"("b":[true,false,null],"e":[],"o":{},"x":[[1,2.5],{"y":[0.1]}]})";
  EXPECT_EQ(JsonText(Json::parse(text)), text);
}

RC_GTEST_PROP(JsonTextProperty, EveryNumberReadsBack, ()) {
  const auto number = std::bit_cast<double>(*rc::gen::arbitrary<std::uint64_t>() << *rc::gen::inRange(0, 64));
  RC_PRE(std::isfinite(number));
  RC_ASSERT(Json::parse(JsonText(number)).get<double>() == number);
}

}  // namespace
}  // namespace priamos::bus
