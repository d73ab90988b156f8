#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "bus/type_files.hpp"
#include "radio/radio_app.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

constexpr const char* kForeignType =
    "package yours;\n"
    "struct tank_t {\n"
    "  int64_t timestamp;  // [us] @age 1000000 @step 10000: when\n"
    "  double level_m;     // [m] @range 0,10 @step 0.01: water\n"
    "}\n";
constexpr const char* kForeignLink = R"(
simulation_key = true
[[channel]]
name = "TANK"
type = "tank_t"
direction = "up"
class = "state"
rate_hz = 10
[[channel]]
name = "DETAILS"
type = "tank_t"
direction = "up"
class = "state"
rate_hz = 10
on_request = true
)";

/// One link.toml for both ends, given as their configuration, and a folder of types.
struct ForeignTypes : testing::Test {
  explicit ForeignTypes(const std::string& link = kForeignLink) {
    std::filesystem::create_directories(folder / "types");
    std::ofstream(folder / "types" / "tank_t.lcm") << kForeignType;
    std::ofstream(folder / "link.toml") << link;
    types = (folder / "types").string();
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", {});
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(
          bus::FactoryOf<RadioApp>(), side,
          {(folder / "link.toml").string(), {"side=" + side, "port=tty-" + side, "types=" + types}});
    lockstep.SetTap([&](std::string_view bus, Time, std::string_view channel, auto bytes) {
      if (channel == "TANK") ++n_tanks[bus == "offboard"];
      if (bus == "offboard" && channel == "TANK") tanks.emplace_back(bytes.begin(), bytes.end());
      if (bus == "offboard" && channel == "DETAILS") ++details;
    });
  }
  std::vector<std::byte> Tank(double level_m) {
    const bus::Schema foreign(bus::ReadTypeFiles(types));
    return bus::FromJson(*foreign.Find("tank_t"),
                         {{"timestamp", ToUtime(lockstep.now())}, {"level_m", level_m}});
  }
  void Run(double seconds) {
    const Time end = lockstep.now() + FromSeconds(seconds);
    while (lockstep.now() < end) {
      for (const char* channel : {"TANK", "DETAILS"})
        lockstep.DriverNode("onboard").PublishRaw(channel, Tank(1.234));
      lockstep.RunUntil(lockstep.now() + FromSeconds(0.05));
    }
  }

  TemporaryFolder folder;
  bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep{schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
  std::string types;
  std::vector<std::vector<std::byte>> tanks;
  std::array<int, 2> n_tanks{};  ///< on the bus onboard and offboard
  int details = 0;
};

/// The same channel up and down.
struct BothWays : ForeignTypes {
  BothWays()
      : ForeignTypes(
            "simulation_key = true\n[[channel]]\nname = \"TANK\"\ntype = \"tank_t\"\ndirection = \"up\"\n"
            "class = \"state\"\nrate_hz = 10\n[[channel]]\nname = \"TANK\"\ntype = \"tank_t\"\n"
            "direction = \"down\"\nclass = \"state\"\nrate_hz = 10\n") {}
};

TEST_F(BothWays, WhatTheLinkBroughtIsNotSentBack) {
  lockstep.RunUntil(lockstep.now() + FromSeconds(3));
  for (const char* side : {"onboard", "offboard"}) {
    n_tanks = {};
    lockstep.DriverNode(side).PublishRaw("TANK", Tank(1.234));
    lockstep.RunUntil(lockstep.now() + FromSeconds(5));
    EXPECT_EQ(n_tanks[0], 1) << side;
    EXPECT_EQ(n_tanks[1], 1) << side;
  }
}

TEST_F(ForeignTypes, AreBridged) {
  Run(2);
  ASSERT_GT(tanks.size(), 10U);
  const bus::Schema foreign(bus::ReadTypeFiles(types));
  EXPECT_NEAR(bus::ToJson(*foreign.Find("tank_t"), tanks.back()).at("level_m").get<double>(), 1.23, 1e-9);
}

TEST_F(ForeignTypes, OnRequestIsSentWhileSomebodyListens) {
  Run(2);
  EXPECT_EQ(details, 0);
  auto requests = lockstep.DriverNode("offboard").Advertise(channels::kLinkRequest);
  link_request_t request{};
  request.channel = "DETAILS";
  request.hold_s = 2;
  requests.Publish(request);
  Run(1.5);
  EXPECT_GT(details, 8);
  Run(1.5);
  details = 0;
  Run(2);
  EXPECT_EQ(details, 0);
}

TEST_F(ForeignTypes, StatusCountsWhatNobodyWanted) {
  auto status = lockstep.DriverNode("onboard").Subscribe(channels::kLinkStatus);
  Run(3);
  ASSERT_NE(status.get(), nullptr);
  ASSERT_EQ(status.get()->all_channels, 2);
  EXPECT_TRUE(status.get()->onboard);
  EXPECT_GT(status.get()->channels[1].unwanted, 30);
  EXPECT_EQ(status.get()->channels[0].unwanted, 0);
  EXPECT_GT(status.get()->utilisation_in, 0);
}

}  // namespace
}  // namespace priamos::radio
