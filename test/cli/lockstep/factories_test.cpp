#include "cli/lockstep/factories.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <stdexcept>

namespace priamos::cli {
namespace {

const std::vector<std::string> kModules{"console", "head", "planner", "radio", "robot", "teleop", "world"};

TEST(Factories, EveryModuleIsMadeUnderItsOwnName) {
  for (const std::string& module : kModules) {
    const bus::AppFactory dut = FactoryFor(module);
    EXPECT_EQ(dut.name, module);
    EXPECT_FALSE(dut.summary.empty()) << module;
    EXPECT_TRUE(dut.start) << module;
    EXPECT_TRUE(dut.default_bus == "onboard" || dut.default_bus == "offboard") << module;
  }
}

TEST(Factories, EveryKeyIsListedOnceWithItsMeaning) {
  for (const std::string& module : kModules) {
    std::set<std::string> names;
    for (const ConfigKey& key : ConfigKeysOf(module)) {
      EXPECT_TRUE(names.insert(key.name).second) << module << ": " << key.name << " twice";
      EXPECT_FALSE(key.meaning.empty()) << module << ": " << key.name;
    }
    EXPECT_FALSE(names.empty()) << module;
  }
}

TEST(Factories, EveryOptionOfAProcessSetsAKeyThatThereIs) {
  for (const std::string& module : kModules) {
    std::set<std::string> names;
    for (const ConfigKey& key : ConfigKeysOf(module)) names.insert(key.name);
    for (const bus::OptionAlias& alias : FactoryFor(module).aliases)
      EXPECT_TRUE(names.contains(std::string(alias.key)))
          << module << " " << alias.flag << " sets " << alias.key;
  }
}

TEST(Factories, ThereIsOneForEveryFolderThatHasAnApp) {
  for (const auto& entry : std::filesystem::directory_iterator(PRIAMOS_SOURCE_DIR "/modules")) {
    const std::string module = entry.path().filename();
    if (!std::filesystem::exists(entry.path() / (module + "_app.hpp"))) continue;
    EXPECT_EQ(FactoryFor(module).name, module);
  }
}

TEST(Factories, AnUnknownNameIsRefused) {
  for (const char* module : {"", "Robot", "spacenavd", "wheels"}) {
    EXPECT_THROW(FactoryFor(module), std::invalid_argument) << module;
    EXPECT_THROW(ConfigKeysOf(module), std::invalid_argument) << module;
  }
}

}  // namespace
}  // namespace priamos::cli
