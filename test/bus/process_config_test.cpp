#include "bus/process_config.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::bus {
namespace {

using support::ThrownReason;
using testing::HasSubstr;

struct SmallConfig {
  int wheels = 4;
  void Describe(Archive& a) { a.Integer("wheels", wheels, {"-", 1, 8, "how many"}); }
};

class ProcessConfig : public testing::Test {
 protected:
  ConfigSource Source(const std::string& text) const {
    std::ofstream(folder_ / "small.toml") << text;
    return {(folder_ / "small.toml").string(), {}};
  }
  TemporaryFolder folder_;
};

TEST_F(ProcessConfig, TheBusIsBesideTheKeysOfTheApp) {
  const auto source =
      Source("wheels = 3\n[bus]\nname = \"offboard\"\nttl = 1\nnetwork = \"eth1\"\nrobot = \"hektor\"\n");
  EXPECT_EQ(LoadAppConfig<SmallConfig>(source).wheels, 3);
  const BusChoice choice = LoadBusChoice(source, {});
  EXPECT_EQ(choice.bus, "offboard");
  EXPECT_EQ(choice.robot, "hektor");
  EXPECT_EQ(choice.Url(), BusUrl("hektor", BusSide::kOffboard, 1) + "&network=eth1");
}

TEST_F(ProcessConfig, WhatIsLeftOutKeepsTheDefault) {
  BusChoice standard;
  standard.bus = "onboard";
  const BusChoice choice = LoadBusChoice(Source("wheels = 3\n"), standard);
  EXPECT_EQ(choice.bus, "onboard");
  EXPECT_EQ(choice.ttl, 0);
  EXPECT_EQ(choice.network, "");
}

TEST_F(ProcessConfig, WrongKeysOfTheBusAreRefused) {
  EXPECT_THAT(ThrownReason([&] { LoadAppConfig<SmallConfig>(Source("[bus]\nttl = 300\n")); }),
              HasSubstr("small.toml:2:bus.ttl: expected a whole number, 0 to 255"));
  EXPECT_THAT(ThrownReason([&] { LoadAppConfig<SmallConfig>(Source("[bus]\nnetwrok = \"eth1\"\n")); }),
              HasSubstr("nearest: \"bus.network\""));
}

}  // namespace
}  // namespace priamos::bus
