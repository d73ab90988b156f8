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
  ReadAs<StopOrder>(R"({"type":"stop","why":"smoke"})");
  const auto aim = ReadAs<AimOrder>(R"({"type":"aim","pan_rad":0.5,"tilt_rad":-0.1,"zoom_step":700})");
  EXPECT_EQ(aim.pan_rad, 0.5);
  EXPECT_EQ(aim.zoom_step, 700);
  EXPECT_FALSE(aim.focus_step || aim.vergence_rad);
  const auto seen = ReadAs<AlarmSeen>(R"({"type":"alarm","source":"head","utime":1800000000000000})");
  EXPECT_EQ(seen.source, "head");
  EXPECT_EQ(seen.utime, 1'800'000'000'000'000);
  const auto wish = ReadAs<ListenWish>(R"({"type":"listen","channel":"SONAR_RANGES","on":true})");
  EXPECT_EQ(wish.channel, "SONAR_RANGES");
  EXPECT_TRUE(wish.on);
}

TEST(BrowserMessage, PlacesAreRead) {
  EXPECT_EQ(ReadAs<PlaceOrder>(R"({"type":"place","x_m":1,"y_m":2,"yaw_rad":0.5})").map_from_base.yaw, 0.5);
}

TEST(BrowserMessage, WhatALogIsToDoIsRead) {
  EXPECT_EQ(ReadAs<ReplayOrder>(R"({"type":"replay","action":"step"})").kind, ReplayOrder::Kind::kStep);
  EXPECT_EQ(ReadAs<ReplayOrder>(R"({"type":"replay","action":"seek","value":12.5})").value, 12.5);
}

TEST(BrowserMessage, OrdersToProcessesAreRead) {
  using enum ProcessWish::Kind;
  const auto log =
      ReadAs<ProcessWish>(R"({"type":"process","action":"log","name":"onboard-robot","end":17})");
  EXPECT_EQ(log.kind, kLog);
  EXPECT_EQ(log.name, "onboard-robot");
  EXPECT_EQ(log.end_bytes, 17);
  EXPECT_EQ(ReadAs<ProcessWish>(R"({"type":"process","action":"restart","name":"line"})").kind, kRestart);
  EXPECT_EQ(ReadAs<ProcessWish>(R"({"type":"process","action":"new_world","name":"door"})").kind, kNewWorld);
}

TEST(BrowserMessage, WishesForParametersAreRead) {
  using enum ParameterWish::Kind;
  const auto set = ReadAs<ParameterWish>(
      R"({"type":"parameter","action":"set","process":"robot","key":"drive.gap_m","value":0.25})");
  EXPECT_EQ(set.kind, kSet);
  EXPECT_EQ(set.process, "robot");
  EXPECT_EQ(set.key, "drive.gap_m");
  EXPECT_EQ(set.value, 0.25);
  EXPECT_EQ(ReadAs<ParameterWish>(R"({"type":"parameter","action":"read","process":"head","key":"a"})").key,
            "a");
  EXPECT_EQ(ReadAs<ParameterWish>(R"({"type":"parameter","action":"read","process":"head"})").key, "");
  EXPECT_EQ(ReadAs<ParameterWish>(R"({"type":"parameter","action":"save","process":"head"})").kind, kSave);
  EXPECT_EQ(ReadAs<ParameterWish>(R"({"type":"parameter","action":"reset","process":"head"})").kind, kReset);
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
        Wrong{std::string(1100, '['), "at most 1024 bytes, got 1100"},
        Wrong{std::string(500, '['), "expected JSON"},
        Wrong{R"({"type":"fly"})",
              "expected stick, stop, mission, place, aim, alarm, listen, parameter, process or replay"},
        Wrong{R"({"type":3})", "type: expected a text"}, Wrong{R"({})", "\"type\" is missing"},
        Wrong{R"({"type":"alarm","source":"robot","utime":1,"now":true})", "\"now\" is not known"},
        Wrong{R"({"type":"stick","axis":[0,0,0,0,0,0]})", "\"beat\" is missing"},
        Wrong{R"({"type":"stick","beat":1.5,"axis":[0,0,0,0,0,0]})", "beat: expected a whole number"},
        Wrong{R"({"type":"stick","beat":-1,"axis":[0,0,0,0,0,0]})", "beat: expected a whole number"},
        Wrong{R"({"type":"stick","beat":18446744073709551615,"axis":[0,0,0,0,0,0]})", "beat: expected"},
        Wrong{R"({"type":"stick","beat":1,"axis":[0,0,0,0,0]})", "axis: expected 6 numbers"},
        Wrong{R"({"type":"stick","beat":1,"axis":[0,0,1.01,0,0,0]})", "axis[2]: expected -1 to 1"},
        Wrong{R"({"type":"stick","beat":1,"axis":[1e999,0,0,0,0,0]})", "expected"},
        Wrong{R"({"type":"stick","beat":1,"axis":[null,0,0,0,0,0]})", "axis[0]: expected -1 to 1"},
        Wrong{R"({"type":"stick","beat":1,"axis":[0,0,0,0,0,0],"hold":1})", "hold: expected true or false"},
        Wrong{R"({"type":"place","x_m":1,"y_m":2,"yaw_rad":0,"turn":true})", "\"turn\" is not known"},
        Wrong{R"({"type":"place","x_m":1,"y_m":null,"yaw_rad":0})", "y_m: expected a number"},
        Wrong{R"({"type":"aim","pan_rad":0.5})", "\"tilt_rad\" is missing"},
        Wrong{R"({"type":"aim","pan_rad":2.5,"tilt_rad":0})", "pan_rad: expected a number from -2 to 2"},
        Wrong{R"({"type":"aim","pan_rad":0,"tilt_rad":0,"zoom_step":2001})",
              "zoom_step: expected a whole number"},
        Wrong{R"({"type":"alarm","source":"head"})", "\"utime\" is missing"},
        Wrong{R"({"type":"alarm","source":"a much too long name","utime":1})", "source: expected a text"},
        Wrong{R"({"type":"alarm","source":"head","utime":-1})", "utime: expected a whole number"},
        Wrong{R"({"type":"replay","action":"fly"})", "action: expected play, pause, step, seek or speed"},
        Wrong{R"({"type":"replay","action":"seek","value":-1})", "value: expected a number from 0"},
        Wrong{R"({"type":"replay","action":"speed","value":0})", "value: expected a number from 0.1 to 32"},
        Wrong{R"({"type":"replay","action":"play","value":1})", "\"value\" is not known"},
        Wrong{R"({"type":"parameter","action":"fly","process":"robot"})",
              "action: expected read, set, save or reset"},
        Wrong{R"({"type":"parameter","action":"set","process":"robot","key":"a"})", "\"value\" is missing"},
        Wrong{R"({"type":"parameter","action":"set","process":"robot","key":"a","value":null})",
              "value: expected"},
        Wrong{R"({"type":"parameter","action":"set","process":"robot","key":"a","value":1e5})",
              "value: expected"},
        Wrong{R"({"type":"parameter","action":"save","process":"robot","key":"a"})", "\"key\" is not known"},
        Wrong{R"({"type":"parameter","action":"read"})", "\"process\" is missing"},
        Wrong{R"({"type":"process","action":"fly","name":"robot"})", "expected restart, log or new_world"},
        Wrong{R"({"type":"process","action":"restart"})", "\"name\" is missing"},
        Wrong{R"({"type":"process","action":"restart","name":"robot","end":1})", "\"end\" is not known"},
        Wrong{R"({"type":"process","action":"log","name":"robot"})", "\"end\" is missing"},
        Wrong{R"({"type":"process","action":"log","name":"robot","end":-1})", "0 to 2000000000"},
        Wrong{R"({"type":"process","action":"restart","name":"seventeen letters"})", "at most 16 bytes"},
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
