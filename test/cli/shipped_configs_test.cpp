#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "cli/lockstep/factories.hpp"
#include "cli/scenario/mission_file.hpp"
#include "cli/scenario/scenario.hpp"
#include "cli/supervise/deployment.hpp"
#include "common/config.hpp"
#include "head/files/landmark_file.hpp"
#include "test/support/project_files.hpp"

// Every configuration file of every deployment loads, and none lies about that nothing reads.

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

const fs::path kConfigs = fs::path(PRIAMOS_SOURCE_DIR) / "config";

std::string TextOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> Files() {
  std::vector<std::string> files;
  for (const fs::path& file : ProjectFiles("config"))
    if (file.extension() != ".md") files.push_back(fs::relative(file, "config").string());
  return files;
}

/// config/<deployment>/
fs::path Deployment(const std::string& file) {
  return kConfigs / *fs::path(file).begin();
}

bool IsOfAModule(const std::string& file) {
  if (fs::path(file).extension() != ".toml" || fs::path(file).parent_path().has_parent_path()) return false;
  try {
    FactoryFor(fs::path(file).stem());
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

bool IsScenario(const std::string& file) {
  return fs::path(file).parent_path().filename() == "scenarios";
}

/// A body that `priamos see --landmark` looks for.
bool IsLandmarkModel(const std::string& file) {
  return fs::path(file).parent_path().filename() == "models";
}

/// Steps for `priamos mission run`.
bool IsMission(const std::string& file) {
  return fs::path(file).parent_path().filename() == "missions";
}

bool IsForInstalling(const std::string& file) {
  return fs::path(file).filename() == "CMakeLists.txt" ||
         fs::path(file).parent_path().filename() == "systemd" || *fs::path(file).begin() == "install";
}

void ExpectThatScenarioLoads(const std::string& file) {
  const std::string deployment = Deployment(file).string();
  const Scenario scenario = LoadScenario(deployment, fs::path(file).stem());
  EXPECT_TRUE(fs::exists(MapFile(deployment, scenario)));
  for (const auto& process : scenario.processes)
    EXPECT_TRUE(process.config.empty() || fs::exists(fs::path(deployment) / process.config))
        << process.config;
}

void ExpectThatModuleLoads(const std::string& file) {
  std::ostringstream printed;
  FactoryFor(fs::path(file).stem()).print_config(printed, ConfigSource{(kConfigs / file).string(), {}});
  EXPECT_THAT(printed.str(), testing::HasSubstr("# ["));
}

/// Worlds are chosen by hand (`--set world=...`) and loaded by the tests of `world`.
bool IsNamedInAnother(const std::string& file) {
  const std::string name = fs::relative(kConfigs / file, Deployment(file)).string();
  if (name.starts_with("worlds/")) return true;
  const auto files = Files();
  return std::any_of(files.begin(), files.end(), [&](const std::string& other) {
    const std::string text = TextOf(kConfigs / other);
    return other != file && (text.find('"' + name + '"') != std::string::npos ||
                             text.find("map=" + name + '"') != std::string::npos);
  });
}

class ShippedConfig : public testing::TestWithParam<std::string> {};

TEST_P(ShippedConfig, LoadsOrIsNamedByOneThatDoes) {
  const std::string& file = GetParam();
  if (IsOfAModule(file)) {
    ExpectThatModuleLoads(file);
  } else if (fs::path(file).stem() == "deployment") {
    EXPECT_NO_THROW(LoadConfig<cli::Deployment>((kConfigs / file).string()));
  } else if (IsForInstalling(file)) {
    SUCCEED() << "checked by installing";
  } else if (IsScenario(file)) {
    ExpectThatScenarioLoads(file);
  } else if (IsMission(file)) {
    EXPECT_GT(
        OrderOfFile((kConfigs / file).string(), {(Deployment(file) / "planner.toml").string(), {}}).n_steps,
        0);
  } else if (IsLandmarkModel(file)) {
    EXPECT_FALSE(head::LoadPolyhedron((kConfigs / file).string()).points.empty());
  } else {
    EXPECT_TRUE(IsNamedInAnother(file)) << "no configuration names " << file;
  }
}

std::string TestName(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedConfig, testing::ValuesIn(Files()), TestName);

}  // namespace
}  // namespace priamos::cli
