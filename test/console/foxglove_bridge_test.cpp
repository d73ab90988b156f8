#include "console/foxglove_bridge.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bus/own_types.hpp"
#include "bus/wire/typed_message.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::console {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr ClientId kClient = 1;
constexpr Time kNow = FromUtime(1'000'000'000'000);

class FoxgloveBridgeTest : public testing::Test {
 protected:
  FoxgloveBridgeTest() {
    dut_.set_needs([this](ClientId, const std::string& channel, bool on) {
      needs_.push_back((on ? "+" : "-") + channel);
    });
    dut_.Offer("POSE", "pose_t");
    dut_.Offer("SONAR_RANGES", "sonar_ranges_t");
    GroundPlan plan;
    plan.walls.resize(1);
    dut_.OfferScene(&plan, kNow);
    dut_.Join(kClient, Role::kDriver);
  }

  void Hear(double x_m) {
    pose_t pose{};
    pose.utime = ToUtime(kNow);
    pose.x_m = x_m;
    dut_.Hear("POSE", bus::Encode(pose), kNow);
  }
  std::uint32_t IdOf(const std::string& topic) const {
    for (const auto& [message, binary] : sent_) {
      if (binary) continue;
      const json text = json::parse(message);
      if (text["op"] != "advertise") continue;
      for (const json& channel : text["channels"])
        if (channel["topic"] == topic) return channel["id"];
    }
    return 0;
  }
  void Subscribe(std::uint32_t subscription, const std::string& topic) {
    messages_ = sent_.size();
    const json wish{{"op", "subscribe"},
                    {"subscriptions", {{{"id", subscription}, {"channelId", IdOf(topic)}}}}};
    EXPECT_FALSE(dut_.Said(kClient, wish.dump(), false));
  }
  void Unsubscribe(std::uint32_t subscription) {
    dut_.Said(kClient, json{{"op", "unsubscribe"}, {"subscriptionIds", {subscription}}}.dump(), false);
  }
  /// What has come since the newest Subscribe.
  std::vector<json> Came() const {
    std::vector<json> came;
    for (std::size_t i = messages_; i < sent_.size(); ++i)
      if (sent_[i].second && sent_[i].first[0] == '\x01')
        came.push_back(json::parse(sent_[i].first.substr(13)));
    return came;
  }

  std::vector<std::pair<std::string, bool>> sent_;
  std::size_t messages_ = 0;
  std::vector<std::string> needs_;
  const bus::Schema schema_ = bus::OwnTypes();
  FoxgloveBridge dut_{schema_, {}, "run", [this](ClientId, std::string message, bool binary) {
                        sent_.emplace_back(std::move(message), binary);
                        return true;
                      }};
};

TEST_F(FoxgloveBridgeTest, AChannelIsWhatWasSentAsJson) {
  Hear(1);
  Subscribe(1, "POSE");
  EXPECT_THAT(Came(), SizeIs(1)) << "the newest at once";
  Hear(2);
  ASSERT_THAT(Came(), SizeIs(2));
  EXPECT_EQ(Came()[1]["x_m"], 2);
  Unsubscribe(1);
  Hear(3);
  EXPECT_THAT(Came(), SizeIs(2));
}

TEST_F(FoxgloveBridgeTest, TheSceneIsMadeOfTheSameMessages) {
  Hear(1);
  Subscribe(1, "/tf");
  ASSERT_THAT(Came(), SizeIs(1));
  EXPECT_EQ(Came()[0]["translation"]["x"], 1.0);
  Hear(2);
  ASSERT_THAT(Came(), SizeIs(2)) << "nobody looks at the body";
  Subscribe(2, "/scene/plan");
  ASSERT_THAT(Came(), SizeIs(1));
  EXPECT_EQ(Came()[0]["entities"][0]["id"], "plan");
}

TEST_F(FoxgloveBridgeTest, AChannelOfTheBusIsNeededWhileSomethingIsMadeOfIt) {
  Subscribe(1, "SONAR_RANGES");
  Subscribe(2, "/sonars");
  Unsubscribe(1);
  EXPECT_THAT(needs_, ElementsAre("+SONAR_RANGES"));
  Unsubscribe(2);
  Subscribe(3, "/sonars");
  EXPECT_THAT(needs_, ElementsAre("+SONAR_RANGES", "-SONAR_RANGES", "+SONAR_RANGES"));
  dut_.Leave(kClient);
  EXPECT_EQ(needs_.back(), "-SONAR_RANGES");
  EXPECT_FALSE(dut_.Has(kClient));
}

TEST_F(FoxgloveBridgeTest, AChannelNobodyKnewIsOfferedWhenItIsHeard) {
  EXPECT_EQ(IdOf("OTHER"), 0u);
  dut_.Hear("OTHER", bus::Encode(pose_t{}), kNow);
  const auto id = IdOf("OTHER");
  EXPECT_GT(id, 0u);
  dut_.Hear("OTHER", bus::Encode(estop_t{}), kNow);
  EXPECT_GT(IdOf("OTHER"), 0u) << "of another type it is another channel";
  EXPECT_NO_THROW(dut_.Hear("OTHER", std::vector<std::byte>(3), kNow));
}

TEST_F(FoxgloveBridgeTest, WhatAPageMayOrderAClientMayCall) {
  std::vector<std::string> orders;
  FoxgloveBridge dut(schema_, {}, "", [this](ClientId, std::string message, bool binary) {
    sent_.emplace_back(std::move(message), binary);
    return true;
  });
  dut.TakeOrders([&](ClientId, std::string_view message) {
    orders.emplace_back(message);
    return std::optional(Refusal{"expected a driver"});
  });
  dut.Join(kClient, Role::kViewer);
  EXPECT_EQ(dut.RoleOf(kClient), Role::kViewer);
  std::string call("\x02\x01\0\0\0\x05\0\0\0\x04\0\0\0json{}", 19);
  EXPECT_FALSE(dut.Said(kClient, call, true));
  EXPECT_THAT(orders, ElementsAre(R"({"type":"stop"})"));
  EXPECT_THAT(sent_.back().first, testing::HasSubstr("expected a driver"));
}

TEST_F(FoxgloveBridgeTest, ItTellsTheTime) {
  sent_.clear();
  dut_.Tick(kNow, FromUtime(7));
  dut_.Tick(kNow + Duration(50'000), FromUtime(7));
  EXPECT_THAT(sent_, SizeIs(1));
  EXPECT_EQ(sent_[0].first, std::string("\x02\x58\x1b\0\0\0\0\0\0", 9));
}

TEST_F(FoxgloveBridgeTest, ThePicturesOfTheThirdCameraAreATopicForWhoSubscribes) {
  dut_.OfferVideo();
  EXPECT_FALSE(dut_.IsVideoWanted());
  const std::size_t before = sent_.size();
  dut_.ShowVideo("JPEG", kNow);
  EXPECT_EQ(sent_.size(), before) << "nobody looks";
  Subscribe(7, "/third");
  EXPECT_TRUE(dut_.IsVideoWanted());
  EXPECT_THAT(needs_, IsEmpty()) << "the radio carries nothing of it";
  dut_.ShowVideo("JPEG", kNow);
  ASSERT_THAT(Came(), SizeIs(1));
  const json picture = Came()[0];
  EXPECT_EQ(picture["data"], "SlBFRw==");
  EXPECT_EQ(picture["format"], "jpeg");
  Unsubscribe(7);
  EXPECT_FALSE(dut_.IsVideoWanted());
}

}  // namespace
}  // namespace priamos::console
