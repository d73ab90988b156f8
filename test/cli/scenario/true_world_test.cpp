#include "cli/scenario/true_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/archive.hpp"

namespace priamos::cli {
namespace {

const std::string kSim = PRIAMOS_SOURCE_DIR "/config/sim";

bool Same(const world::Solid& a, const world::Solid& b) {
  return a.name == b.name && a.map_from_solid.x == b.map_from_solid.x &&
         a.map_from_solid.y == b.map_from_solid.y && a.map_from_solid.yaw == b.map_from_solid.yaw &&
         a.size_m == b.size_m && a.z_max_m == b.z_max_m;
}

bool Same(const TrueWorld& a, const TrueWorld& b) {
  return std::equal(a.solids.begin(), a.solids.end(), b.solids.begin(), b.solids.end(),
                    [](const auto& x, const auto& y) { return Same(x, y); });
}

bool Has(const TrueWorld& world, const std::string& part_of_name) {
  return std::any_of(world.solids.begin(), world.solids.end(), [&](const world::Solid& solid) {
    return solid.name.find(part_of_name) != std::string::npos;
  });
}

TEST(TrueWorld, IsWhatTheProcessOfTheScenarioDrawsFromTheSeed) {
  const Scenario scenario = LoadScenario(kSim, "door");
  const TrueWorld dut = LoadTrueWorld(kSim, scenario, 3);
  EXPECT_TRUE(Has(dut, "laboratory")) << "the frame and the leaf of the map's door";
  EXPECT_TRUE(Has(dut, "left of the door")) << "its walls";
  EXPECT_TRUE(Same(dut, LoadTrueWorld(kSim, scenario, 3)));
  EXPECT_FALSE(Same(dut, LoadTrueWorld(kSim, scenario, 4)));
}

TEST(TrueWorld, WhatTheScenarioSetsOnTopOfTheFileCounts) {
  Scenario scenario = LoadScenario(kSim, "door");
  const TrueWorld plain = LoadTrueWorld(kSim, scenario, 1);
  for (ScenarioProcess& process : scenario.processes)
    if (process.module == "world") process.set = "world=worlds/door-bare.toml";
  EXPECT_FALSE(Same(plain, LoadTrueWorld(kSim, scenario, 1)));
}

TEST(TrueWorld, WithoutASimulatedWorldThereIsNone) {
  Scenario scenario = LoadScenario(kSim, "door");
  std::erase_if(scenario.processes, [](const ScenarioProcess& p) { return p.module == "world"; });
  EXPECT_TRUE(LoadTrueWorld(kSim, scenario, 1).solids.empty());
}

TEST(TrueWorld, AFileThatIsNotThereIsNamed) {
  const Scenario scenario = LoadScenario(kSim, "door");
  try {
    LoadTrueWorld("/no/such/deployment", scenario, 1);
    FAIL() << "a world was drawn from nothing";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("/no/such/deployment/world.toml"), std::string::npos);
  }
}

}  // namespace
}  // namespace priamos::cli
