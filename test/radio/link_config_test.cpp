#include "bus/radio/link_config.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "bus/own_types.hpp"
#include "bus/radio/budget.hpp"
#include "common/config.hpp"
#include "lcmtypes/channels.hpp"

// The shipped link against the channels of the robot.

namespace priamos::radio {
namespace {

using bus::radio::LinkConfig;

/// The link of one deployment, "sim" or "robot".
class ShippedLink : public testing::TestWithParam<const char*> {
 protected:
  LinkConfig Shipped() const {
    return LoadConfig<LinkConfig>(fmt::format("{}/config/{}/link.toml", PRIAMOS_SOURCE_DIR, GetParam()));
  }
};

TEST_P(ShippedLink, ChannelsAreThoseOfTheRobotWithTheirTypes) {
  for (const auto& channel : Shipped().channels) {
    bool found = false;
    std::apply(
        [&](const auto&... c) {
          ((found = found || (c.name == channel.name &&
                              std::decay_t<decltype(c)>::Message::getTypeName() == channel.type)),
           ...);
        },
        channels::kAll);
    EXPECT_TRUE(found) << channel.name << " " << channel.type;
  }
}

TEST_P(ShippedLink, WhatIsASafetyChannelOnTheBusIsUrgentOnTheLine) {
  for (const auto& channel : Shipped().channels) {
    const auto is_this_safety = [&](const auto& c) {
      return c.name == channel.name && c.safety_act != nullptr;
    };
    const bool safety =
        std::apply([&](const auto&... c) { return (is_this_safety(c) || ...); }, channels::kAll);
    EXPECT_EQ(channel.urgent, safety) << channel.name;
  }
}

TEST_P(ShippedLink, BudgetHolds) {
  const bus::Schema schema = bus::OwnTypes();
  const auto budget = ComputeBudget(Shipped().Table(schema), Shipped().Options());
  EXPECT_THAT(budget.problems, testing::IsEmpty());
  EXPECT_LT(budget.up.utilisation, 0.6);
  EXPECT_LT(budget.down.utilisation, 0.6);
}

INSTANTIATE_TEST_SUITE_P(OfEveryDeployment, ShippedLink, testing::Values("sim", "robot"));

// ---- What both ends must agree on.

constexpr const char* kTank =
    "struct tank_t {\n"
    "  int64_t utime;     // [us] @age 1000000 @step 10000: when\n"
    "  double level_m[3]; // [m] @range 0,10 @step 0.01: water\n"
    "  part_t part[2];\n"
    "}\n"
    "struct part_t {\n"
    "  boolean open;     // [-]: valve\n"
    "  int8_t position;  // [-] @range 0,5: of the handle\n"
    "}\n";
constexpr const char* kText = "struct text_t {\n  string text;  // [ascii] @max 20: words\n}\n";

bus::radio::LinkChannelConfig Channel(const std::string& type, bool delta) {
  bus::radio::LinkChannelConfig channel;
  channel.name = "CHANNEL";
  channel.type = type;
  channel.delta = delta;
  return channel;
}

bus::radio::ChannelTable TableOf(const std::string& lcm, const bus::radio::LinkChannelConfig& channel) {
  const bus::Schema schema(std::vector<bus::Schema::Source>{{"a.lcm", lcm}});
  LinkConfig config;
  config.channels.push_back(channel);
  return config.Table(schema);
}

TEST(LinkConfigTable, EndsWithOtherAnnotationsAreToldApart) {
  std::string other = kTank;
  other.replace(other.find("0,10 @step 0.01"), 15, "5,15 @step 0.01");  // as many bits
  const auto one = TableOf(kTank, Channel("tank_t", false)), two = TableOf(other, Channel("tank_t", false));
  EXPECT_EQ(one.at(0).fixed_bits, two.at(0).fixed_bits);
  EXPECT_NE(one.hash(), two.hash());
  EXPECT_EQ(one.hash(), TableOf(kTank, Channel("tank_t", false)).hash());
}

TEST(LinkConfigTable, RefusingValuesOutOfRangeIsTheSendersAffair) {
  std::string other = kTank;
  other.replace(other.find("0,5: of"), 7, "0,5 @refuse: of");
  EXPECT_EQ(TableOf(kTank, Channel("tank_t", false)).hash(), TableOf(other, Channel("tank_t", false)).hash());
}

TEST(LinkConfigTable, CodesAreAsLongAsConfiguredOrAsTheRateAsks) {
  const auto table = [](int baud, int code_bytes) {
    const bus::Schema schema(std::vector<bus::Schema::Source>{{"a.lcm", kText}});
    LinkConfig config;
    config.baud = baud;
    config.code_bytes = code_bytes;
    config.channels.push_back(Channel("text_t", false));
    return config.Table(schema);
  };
  EXPECT_EQ(table(9600, 0).code_bytes(), 4U);
  EXPECT_EQ(table(9600, 0).hash(), table(9600, 4).hash());
  EXPECT_EQ(table(19200, 0).code_bytes(), 6U);
  EXPECT_EQ(table(115200, 0).hash(), table(9600, 6).hash()) << "the rate itself is no part of it";
  EXPECT_EQ(table(115200, 8).code_bytes(), 8U);
  EXPECT_NE(table(9600, 4).hash(), table(9600, 6).hash());
  EXPECT_NE(table(9600, 6).hash(), table(9600, 8).hash());
  EXPECT_THROW(table(9600, 5), ConfigError);
}

TEST(LinkConfigTable, DifferencesAreBetweenValuesInTheirOrder) {
  EXPECT_THAT(TableOf(kTank, Channel("tank_t", true)).at(0).delta,
              testing::ElementsAre(7, 10, 10, 10, 1, 3, 1, 3));
  EXPECT_THAT(TableOf(kTank, Channel("tank_t", false)).at(0).delta, testing::IsEmpty());
}

TEST(LinkConfigTable, DifferencesNeedAFixedSize) {
  try {
    TableOf(kText, Channel("text_t", true));
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("delta: radio channel CHANNEL: expected false with text_t"));
  }
}

}  // namespace
}  // namespace priamos::radio
