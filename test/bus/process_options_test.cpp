#include "bus/process_options.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "bus/wire/bus_address.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

/// A process whose file names a bus: what the command line and the environment leave of it.
class ProcessOptionsTest : public testing::Test {
 protected:
  ProcessOptionsTest() {
    for (const char* variable : {kBusVariable, kRobotVariable, kTtlVariable, kNetworkVariable})
      unsetenv(variable);
    std::ofstream(folder_ / "a.toml") << "[bus]\nrobot = \"hektor\"\nttl = 1\nnetwork = \"eth1\"\n";
  }
  ~ProcessOptionsTest() override { unsetenv(kNetworkVariable); }

  std::string UrlOf(std::vector<std::string> words) {
    AppFactory factory;
    factory.name = "small";
    factory.default_bus = "onboard";
    ProcessOptions options;
    CLI::App cli("small", "small");
    AddProcessOptions(cli, factory, options);
    std::reverse(words.begin(), words.end());
    cli.parse(words);
    ChooseBus(factory, options);
    return options.bus;
  }
  std::string File() const { return (folder_ / "a.toml").string(); }
  static std::string Onboard(const std::string& robot, int ttl) {
    return BusUrl(robot, BusSide::kOnboard, ttl);
  }

  TemporaryFolder folder_;
};

TEST_F(ProcessOptionsTest, WithoutAWordItIsTheDefaultOfTheModule) {
  EXPECT_EQ(UrlOf({}), Onboard("priamos", 0));
}

TEST_F(ProcessOptionsTest, TheFileNamesTheBus) {
  EXPECT_EQ(UrlOf({"--config", File()}), Onboard("hektor", 1) + "&network=eth1");
}

TEST_F(ProcessOptionsTest, TheEnvironmentWinsOverTheFileAndTheWordOverBoth) {
  setenv(kNetworkVariable, "eth2", 1);
  EXPECT_EQ(UrlOf({"--config", File()}), Onboard("hektor", 1) + "&network=eth2");
  EXPECT_EQ(UrlOf({"--config", File(), "--network", "eth3", "--ttl", "0"}),
            Onboard("hektor", 0) + "&network=eth3");
}

TEST_F(ProcessOptionsTest, AUrlKeepsItsOwnNetwork) {
  EXPECT_EQ(UrlOf({"--config", File(), "--bus", "udpm://239.1.1.1:5000?network=lo"}),
            "udpm://239.1.1.1:5000?network=lo");
  EXPECT_EQ(UrlOf({"--config", File(), "--bus", "udpm://239.1.1.1:5000"}),
            "udpm://239.1.1.1:5000?network=eth1");
  EXPECT_EQ(UrlOf({"--config", File(), "--bus", "memq://"}), "memq://");
}

}  // namespace
}  // namespace priamos::bus
