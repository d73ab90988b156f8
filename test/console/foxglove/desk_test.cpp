#include "console/foxglove/desk.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace priamos::console {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Desk::Client kAnna = 1, kBert = 2;

std::uint64_t NumberIn(const std::string& bytes, std::size_t at, int size) {
  std::uint64_t value = 0;
  for (int i = size - 1; i >= 0; --i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + std::size_t(i)]);
  return value;
}

class DeskTest : public testing::Test {
 protected:
  DeskTest() {
    dut_.set_watcher([this](Desk::Client client, std::uint32_t channel, bool on) {
      watched_.push_back(std::to_string(client) + (on ? " + " : " - ") + std::to_string(channel));
    });
    dut_.set_services({{"stop", "{}"}, {"goto", "{}"}},
                      [this](Desk::Client, std::uint32_t service, std::string_view payload) {
                        calls_.push_back(std::to_string(service) + " " + std::string(payload));
                        return service == 2 ? std::optional(Refusal{"expected x_m"}) : std::nullopt;
                      });
    pose_ = dut_.Offer({"POSE", "pose_t", R"({"type":"object"})"});
    path_ = dut_.Offer({"PATH", "path_t", "{}"});
  }

  std::vector<json> Texts(Desk::Client client) const {
    std::vector<json> texts;
    for (const auto& [to, message, binary] : sent_)
      if (to == client && !binary) texts.push_back(json::parse(message));
    return texts;
  }
  std::vector<std::string> Bytes(Desk::Client client) const {
    std::vector<std::string> bytes;
    for (const auto& [to, message, binary] : sent_)
      if (to == client && binary) bytes.push_back(message);
    return bytes;
  }
  void Say(Desk::Client client, const std::string& text) { EXPECT_FALSE(dut_.Take(client, text, false)); }
  void Subscribe(Desk::Client client, std::uint32_t id, std::uint32_t channel) {
    Say(client, json{{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}}.dump());
  }
  void Call(std::uint32_t service, const std::string& payload) {
    std::string bytes = "\x02";
    for (const std::uint32_t number : {service, 77u, 4u})
      for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(number >> (8 * i) & 0xff));
    EXPECT_FALSE(dut_.Take(kAnna, bytes + "json" + payload, true));
  }

  bool takes_ = true;
  std::vector<std::tuple<Desk::Client, std::string, bool>> sent_;
  std::vector<std::string> watched_, calls_;
  Desk dut_{"PRIAMOS", "run", [this](Desk::Client client, std::string message, bool binary) {
              if (takes_) sent_.emplace_back(client, std::move(message), binary);
              return takes_;
            }};
  std::uint32_t pose_ = 0, path_ = 0;
};

TEST_F(DeskTest, WhoJoinsIsToldWhatThereIs) {
  dut_.Join(kAnna);
  const auto texts = Texts(kAnna);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[0]["op"], "serverInfo");
  EXPECT_EQ(texts[0]["capabilities"], (json{"time", "services"}));
  EXPECT_EQ(texts[1]["op"], "advertise");
  EXPECT_EQ(texts[1]["channels"][0], (json{{"id", pose_},
                                           {"topic", "POSE"},
                                           {"encoding", "json"},
                                           {"schemaName", "pose_t"},
                                           {"schemaEncoding", "jsonschema"},
                                           {"schema", R"({"type":"object"})"}}));
  EXPECT_EQ(texts[2]["services"][1]["name"], "goto");
  EXPECT_EQ(texts[2]["services"][1]["id"], 2);
  EXPECT_EQ(texts[2]["services"][1]["request"]["schemaEncoding"], "jsonschema");
}

TEST_F(DeskTest, AChannelThatComesLaterIsAdvertisedToo) {
  dut_.Join(kAnna);
  sent_.clear();
  const auto id = dut_.Offer({"DOOR", "door_t", "{}"});
  EXPECT_EQ(Texts(kAnna)[0]["channels"][0]["id"], id);
}

TEST_F(DeskTest, AMessageGoesToThoseWhoSubscribedUnderTheirNumbers) {
  dut_.Join(kAnna);
  dut_.Join(kBert);
  Subscribe(kAnna, 40, pose_);
  Subscribe(kBert, 41, path_);
  EXPECT_TRUE(dut_.IsWanted(pose_));
  dut_.Publish(pose_, FromUtime(1'700'000'000'000'001), R"({"x_m":1})");
  ASSERT_EQ(Bytes(kAnna).size(), 1u);
  EXPECT_THAT(Bytes(kBert), IsEmpty());
  const std::string bytes = Bytes(kAnna)[0];
  EXPECT_EQ(bytes[0], '\x01');
  EXPECT_EQ(NumberIn(bytes, 1, 4), 40u);
  EXPECT_EQ(NumberIn(bytes, 5, 8), 1'700'000'000'000'001'000u);
  EXPECT_EQ(bytes.substr(13), R"({"x_m":1})");
}

TEST_F(DeskTest, AChannelIsWatchedFromItsFirstSubscriptionToItsLast) {
  dut_.Join(kAnna);
  Subscribe(kAnna, 1, pose_);
  Subscribe(kAnna, 2, pose_);
  Subscribe(kAnna, 2, path_);  // the number is in use
  Say(kAnna, R"({"op":"unsubscribe","subscriptionIds":[1,1,9]})");
  EXPECT_THAT(watched_, ElementsAre("1 + 1"));
  Say(kAnna, R"({"op":"unsubscribe","subscriptionIds":[2]})");
  Subscribe(kAnna, 3, path_);
  dut_.Leave(kAnna);
  EXPECT_THAT(watched_, ElementsAre("1 + 1", "1 - 1", "1 + 2", "1 - 2"));
  EXPECT_FALSE(dut_.IsWanted(path_));
}

TEST_F(DeskTest, ACallIsDoneOrAnsweredWithTheReason) {
  dut_.Join(kAnna);
  sent_.clear();
  Call(1, "{}");
  ASSERT_EQ(Bytes(kAnna).size(), 1u);
  const std::string answer = Bytes(kAnna)[0];
  EXPECT_EQ(answer[0], '\x03');
  EXPECT_EQ(NumberIn(answer, 1, 4), 1u);
  EXPECT_EQ(NumberIn(answer, 5, 4), 77u);
  EXPECT_EQ(answer.substr(13), R"(json{"done":true})");
  Call(2, "{}");
  Call(3, "{}");
  EXPECT_THAT(calls_, ElementsAre("1 {}", "2 {}"));
  EXPECT_EQ(Texts(kAnna)[0]["message"], "expected x_m");
  EXPECT_EQ(Texts(kAnna)[1]["message"], "there is no such service");
}

TEST_F(DeskTest, WhatIsNotThereCostsAWarningWhatIsNonsenseTheConnection) {
  dut_.Join(kAnna);
  sent_.clear();
  Subscribe(kAnna, 1, 99);
  Say(kAnna, R"({"op":"getParameters"})");
  EXPECT_EQ(Texts(kAnna)[0]["message"], "there is no channel 99");
  EXPECT_EQ(Texts(kAnna)[1]["message"], "this station does not offer parameters");
  EXPECT_TRUE(dut_.Take(kAnna, "nonsense", false));
}

TEST_F(DeskTest, WhatAClientIsTooSlowForIsCounted) {
  dut_.Join(kAnna);
  Subscribe(kAnna, 1, pose_);
  takes_ = false;
  dut_.Publish(pose_, {}, "{}");
  EXPECT_EQ(dut_.dropped(), 1u);
}

}  // namespace
}  // namespace priamos::console
