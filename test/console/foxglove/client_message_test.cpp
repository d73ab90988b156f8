#include "console/foxglove/client_message.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace priamos::console {
namespace {

using testing::HasSubstr;

std::string Number(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  return bytes;
}

TEST(ClientMessage, SubscriptionsAreRead) {
  const auto dut =
      ReadClientText(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":3},{"id":0,"channelId":1}]})");
  ASSERT_TRUE(dut) << dut.reason();
  const auto& wishes = std::get<SubscribeRequest>(*dut).wishes;
  ASSERT_EQ(wishes.size(), 2u);
  EXPECT_EQ(wishes[0].subscription, 7u);
  EXPECT_EQ(wishes[0].channel, 3u);
  const auto end = ReadClientText(R"({"op":"unsubscribe","subscriptionIds":[7]})");
  EXPECT_EQ(std::get<UnsubscribeRequest>(*end).subscriptions, std::vector<std::uint32_t>{7});
}

TEST(ClientMessage, ACallIsRead) {
  const auto dut = ReadClientBytes("\x02" + Number(258) + Number(9) + Number(4) + "json{\"x_m\":1}");
  ASSERT_TRUE(dut) << dut.reason();
  const auto& call = std::get<ServiceRequest>(*dut);
  EXPECT_EQ(call.service, 258u);
  EXPECT_EQ(call.call, 9u);
  EXPECT_EQ(call.encoding, "json");
  EXPECT_EQ(call.payload, "{\"x_m\":1}");
}

TEST(ClientMessage, RequestsForParametersAreRead) {
  const auto get = ReadClientText(R"({"op":"getParameters","parameterNames":["robot/a","head/b"],"id":"7"})");
  ASSERT_TRUE(get) << get.reason();
  EXPECT_EQ(std::get<GetParametersRequest>(*get).names, (std::vector<std::string>{"robot/a", "head/b"}));
  EXPECT_EQ(std::get<GetParametersRequest>(*get).id, "7");
  EXPECT_TRUE(std::get<GetParametersRequest>(*ReadClientText(R"({"op":"getParameters"})")).names.empty());
  const auto watch = ReadClientText(R"({"op":"subscribeParameterUpdates","parameterNames":["robot/a"]})");
  EXPECT_TRUE(std::get<WatchParametersRequest>(*watch).on);
  const auto end = ReadClientText(R"({"op":"unsubscribeParameterUpdates","parameterNames":[]})");
  EXPECT_FALSE(std::get<WatchParametersRequest>(*end).on);
}

TEST(ClientMessage, ChangesOfParametersAreReadAndWhatIsNoNumberIsNone) {
  const auto dut = ReadClientText(
      R"({"op":"setParameters","id":"3","parameters":[{"name":"a","value":0.5},{"name":"b","value":"x"},{"name":"c"}]})");
  ASSERT_TRUE(dut) << dut.reason();
  const auto& request = std::get<SetParametersRequest>(*dut);
  EXPECT_EQ(request.id, "3");
  ASSERT_EQ(request.changes.size(), 3u);
  EXPECT_EQ(request.changes[0].value, 0.5);
  EXPECT_EQ(request.changes[1].value, std::nullopt);
  EXPECT_EQ(request.changes[2].value, std::nullopt);
}

TEST(ClientMessage, DamagedRequestsForParametersAreRefused) {
  for (const char* text :
       {R"({"op":"getParameters","parameterNames":7})", R"({"op":"getParameters","parameterNames":[7]})",
        R"({"op":"getParameters","id":7})", R"({"op":"setParameters"})",
        R"({"op":"setParameters","parameters":[3]})", R"({"op":"setParameters","parameters":[{"name":3}]})"})
    EXPECT_FALSE(ReadClientText(text)) << text;
}

TEST(ClientMessage, WhatThisServerDoesNotOfferIsNamed) {
  for (const char* op : {"subscribeConnectionGraph", "advertise", "fetchAsset"}) {
    const auto dut = ReadClientText(std::string(R"({"op":")") + op + "\"}");
    EXPECT_EQ(std::get<OtherRequest>(*dut).operation, op);
  }
  EXPECT_EQ(std::get<OtherRequest>(*ReadClientBytes("\x01" + Number(1) + "{}")).operation, "publish");
}

TEST(ClientMessage, NonsenseIsRefusedWithASentence) {
  for (const char* text :
       {"", "x", "[]", "{}", R"({"op":1})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":3})", R"({"op":"subscribe","subscriptions":[7]})",
        R"({"op":"subscribe","subscriptions":[{"id":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
        R"({"op":"unsubscribe","subscriptionIds":["a"]})"})
    EXPECT_THAT(ReadClientText(text).reason(), HasSubstr("expected")) << text;
  EXPECT_THAT(ReadClientText(std::string(kMaxClientMessage + 1, ' ')).reason(), HasSubstr("at most"));
  std::string many = R"({"op":"unsubscribe","subscriptionIds":[0)";
  for (int i = 0; i < 1000; ++i) many += ",0";
  EXPECT_THAT(ReadClientText(many + "]}").reason(), HasSubstr("at most 1000"));
  for (const std::string& bytes : {std::string(), std::string("\x03"), "\x02" + Number(1),
                                   "\x02" + Number(1) + Number(1) + Number(0xffffffff) + "json",
                                   "\x02" + Number(1) + Number(1) + Number(5) + "json"})
    EXPECT_THAT(ReadClientBytes(bytes).reason(), HasSubstr("expected"));
}

RC_GTEST_PROP(ClientMessage, AnyBytesAreReadOrRefused, (const std::string& bytes)) {
  for (const auto& dut : {ReadClientText(bytes), ReadClientBytes(bytes), ReadClientBytes("\x02" + bytes)})
    RC_ASSERT(static_cast<bool>(dut) == dut.reason().empty());
}

}  // namespace
}  // namespace priamos::console
