#include "console/core/browser_message.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace priamos::console {
namespace {

using testing::HasSubstr;

template <class T>
T ReadAs(const std::string& text) {
  const auto message = ReadBrowserMessage(text);
  EXPECT_EQ(message.reason(), "") << text;
  return message && std::holds_alternative<T>(*message) ? std::get<T>(*message) : T{};
}

const std::string kStick =
    R"({"type":"stick","beat":7,"axis":[1,-0.5,0,0,0,0.25],"hold":true,"rearm":false})";

TEST(BrowserMessage, AStickReportIsRead) {
  const auto report = ReadAs<StickReport>(kStick);
  EXPECT_EQ(report.beat, 7);
  EXPECT_THAT(report.axis, testing::ElementsAre(1, -0.5, 0, 0, 0, 0.25));
  EXPECT_TRUE(report.hold);
  EXPECT_FALSE(report.rearm || report.take_over || report.mode || report.range);
}

TEST(BrowserMessage, OrdersAreRead) {
  ReadAs<StopOrder>(R"({"type":"stop"})");
  EXPECT_EQ(ReadAs<MissionOrder>(R"({"type":"mission","order":"pass_door","landmark":3})").landmark_id, 3);
  EXPECT_TRUE(ReadAs<MissionOrder>(R"({"type":"mission","order":"abort"})").abort);
  const auto wish = ReadAs<ListenWish>(R"({"type":"listen","channel":"SONAR_RANGES","on":true})");
  EXPECT_EQ(wish.channel, "SONAR_RANGES");
  EXPECT_TRUE(wish.on);
}

struct Wrong {
  std::string text, reason;
};

class WrongBrowserMessage : public testing::TestWithParam<Wrong> {};

TEST_P(WrongBrowserMessage, IsRefusedWithASentence) {
  EXPECT_THAT(ReadBrowserMessage(GetParam().text).reason(), HasSubstr(GetParam().reason)) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongBrowserMessage,
    testing::Values(
        Wrong{"", "expected JSON"}, Wrong{"{", "expected JSON"}, Wrong{"\xff\xfe", "expected JSON"},
        Wrong{"[]", "expected a JSON object"}, Wrong{"null", "expected a JSON object"},
        Wrong{std::string(600, '['), "at most 512 bytes, got 600"},
        Wrong{std::string(500, '['), "expected JSON"},
        Wrong{R"({"type":"fly"})", "expected stick, stop, mission or listen"},
        Wrong{R"({"type":3})", "type: expected a text"}, Wrong{R"({})", "\"type\" is missing"},
        Wrong{R"({"type":"stop","now":true})", "\"now\" is not known"},
        Wrong{R"({"type":"stick","axis":[0,0,0,0,0,0]})", "\"beat\" is missing"},
        Wrong{R"({"type":"stick","beat":1.5,"axis":[0,0,0,0,0,0]})", "beat: expected a whole number"},
        Wrong{R"({"type":"stick","beat":-1,"axis":[0,0,0,0,0,0]})", "beat: expected a whole number"},
        Wrong{R"({"type":"stick","beat":18446744073709551615,"axis":[0,0,0,0,0,0]})", "beat: expected"},
        Wrong{R"({"type":"stick","beat":1,"axis":[0,0,0,0,0]})", "axis: expected 6 numbers"},
        Wrong{R"({"type":"stick","beat":1,"axis":[0,0,1.01,0,0,0]})", "axis[2]: expected -1 to 1"},
        Wrong{R"({"type":"stick","beat":1,"axis":[1e999,0,0,0,0,0]})", "expected"},
        Wrong{R"({"type":"stick","beat":1,"axis":[null,0,0,0,0,0]})", "axis[0]: expected -1 to 1"},
        Wrong{R"({"type":"stick","beat":1,"axis":[0,0,0,0,0,0],"hold":1})", "hold: expected true or false"},
        Wrong{R"({"type":"mission","order":"fly"})", "order: expected abort or pass_door"},
        Wrong{R"({"type":"mission","order":"pass_door"})", "\"landmark\" is missing"},
        Wrong{R"({"type":"mission","order":"pass_door","landmark":0})",
              "landmark: expected a whole number from 1"},
        Wrong{R"({"type":"mission","order":"pass_door","landmark":1000})", "from 1 to 999"},
        Wrong{R"({"type":"listen","channel":7,"on":true})", "channel: expected a text"}));

RC_GTEST_PROP(BrowserMessageProperty, AnyBytesAreAMessageOrASentence, (const std::string& text)) {
  const auto message = ReadBrowserMessage(text);
  RC_ASSERT(bool(message) == message.reason().empty());
}

RC_GTEST_PROP(BrowserMessageProperty, ADamagedReportIsRefusedOrInRange, ()) {
  std::string text = kStick;
  const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
  text[at] = *rc::gen::arbitrary<char>();
  const auto message = ReadBrowserMessage(text);
  if (!message || !std::holds_alternative<StickReport>(*message)) return;
  for (const double v : std::get<StickReport>(*message).axis) RC_ASSERT(v >= -1 && v <= 1);
}

}  // namespace
}  // namespace priamos::console
