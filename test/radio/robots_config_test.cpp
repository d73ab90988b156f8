#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "common/config.hpp"
#include "radio/radio_app.hpp"
#include "test/support/thrown_reason.hpp"

// What the files of several robots on one channel say together: modules/radio/tutorial/robots.

namespace priamos::radio {
namespace {

using support::ThrownReason;
using testing::HasSubstr;

const std::string kFolder = std::string(PRIAMOS_SOURCE_DIR) + "/modules/radio/tutorial/robots/";

/// Why the process does not start with one of the files and some keys changed.
std::string Refusal(const std::string& file, const std::vector<std::string>& overrides) {
  const bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep{schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
  lockstep.AddBus("onboard");
  lockstep.AddSerialLine("tty-a", "tty-b", {});
  std::vector<std::string> all{"port=tty-a"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return ThrownReason([&] { lockstep.AddApp(bus::FactoryOf<RadioApp>(), "onboard", {kFolder + file, all}); });
}

TEST(RobotsConfig, ARobotNeedsAnAddressOfItsChannel) {
  EXPECT_THAT(Refusal("robot.toml", {}), HasSubstr("address: expected 1 to 2 with robots = 2"));
  EXPECT_THAT(Refusal("robot.toml", {"address=3"}), HasSubstr("address: expected at most 2"));
  EXPECT_THAT(Refusal("robot.toml", {"address=-1"}), HasSubstr("address: expected"));
  EXPECT_EQ(Refusal("robot.toml", {"address=2"}), "");
}

TEST(RobotsConfig, AStationKnowsEachRobotOnce) {
  EXPECT_THAT(Refusal("station.toml", {"side=onboard"}), HasSubstr("robot: expected none onboard"));
  EXPECT_THAT(Refusal("robot.toml", {"side=offboard"}),
              HasSubstr("robot.toml:1:robot: expected 2 [[robot]] tables"));
}

/// Two links in one memory take each other's events for their own: a stop would reach the other robot.
TEST(RobotsConfig, RobotsShareNoMemory) {
  const auto robots = [](const std::string& alpha, const std::string& beta) {
    return std::vector<std::string>{"side=offboard",
                                    "robot=[{name=\"alpha\"," + alpha + "},{name=\"beta\"," + beta + "}]"};
  };
  EXPECT_THAT(Refusal("station.toml", robots("state_file=\"x\"", "state_file=\"./x\"")),
              HasSubstr("robot[1].state_file: expected a file of its own, got that of robot[0].state_file"));
  EXPECT_THAT(Refusal("station.toml", robots("state_file=\"x\"", "state_file=\"y\",fast_state_file=\"x\"")),
              HasSubstr("robot[1].fast_state_file: expected a file of its own"));
  EXPECT_THAT(Refusal("station.toml", {"state_file=x"}),
              HasSubstr("state_file: expected none beside [[robot]]"));
  EXPECT_THAT(Refusal("station.toml", {"address=1"}), HasSubstr("address: expected 0 at a station"));
}

TEST(RobotsConfig, ANameThatIsNoneOfAChannelIsRefused) {
  const std::vector<std::string> names{"", std::string(64, 'A'), "A\\u001bB", "A B"};
  for (const std::string& name : names) {
    const std::string channel =
        "channel=[{name=\"" + name + "\",type=\"pose_t\",direction=\"up\",class=\"state\"}]";
    const std::string why = ThrownReason([&] { LoadConfig<bus::radio::LinkConfig>({"", {channel}}); });
    EXPECT_THAT(why, HasSubstr("the name of an LCM channel")) << name;
  }
}

TEST(RobotsConfig, WhatContradictsASharedChannelIsRefused) {
  const auto refusal = [](const std::string& key) {
    return ThrownReason([&] { LoadConfig<bus::radio::LinkConfig>({kFolder + "link.toml", {key}}); });
  };
  EXPECT_EQ(refusal("robots=8"), "");
  EXPECT_THAT(refusal("robots=9"), HasSubstr("robots: expected"));
  EXPECT_THAT(refusal("datagrams=true"), HasSubstr("robots: expected 0 with datagrams"));
  EXPECT_THAT(refusal("half_duplex_turn_s=0.5"), HasSubstr("half_duplex_turn_s: expected 0 with robots"));
  EXPECT_THAT(refusal("max_bundle_bytes=15"), HasSubstr("max_bundle_bytes: expected"));
  EXPECT_THAT(refusal("robots=0"), HasSubstr("max_bundle_bytes: expected 30 or more"));
}

}  // namespace
}  // namespace priamos::radio
