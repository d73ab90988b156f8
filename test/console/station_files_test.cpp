#include "console/station_files.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bus/own_types.hpp"
#include "bus/schema/schema.hpp"

namespace priamos::console {
namespace {

TEST(StationFiles, HaveThePageTheTypesAndLaterTheParameters) {
  StationFiles dut(bus::OwnTypes());
  EXPECT_TRUE(dut.files().contains("/"));
  EXPECT_TRUE(dut.files().contains("/plots.js"));
  const auto pose = nlohmann::json::parse(dut.files().at("/types/priamos.pose_t.json").text);
  EXPECT_EQ(pose["properties"]["x_m"]["description"].get<std::string>().substr(0, 3), "[m]");
  EXPECT_FALSE(dut.files().contains("/parameters/index.json"));
  const WebFiles& served = dut.files();
  const bus::ParameterSheet live{
      ParameterTable(std::vector<Parameter>{{"speed_m_s", "m/s", "fastest", 0, 1, LiveChange::kOnlyLower}}),
      {0.3}};
  dut.AddParameters({{"robot", {"speed_m_s = 0.3", live}}, {"teleop", {"rate_hz = 50"}}});
  EXPECT_EQ(served.at("/parameters/robot.toml").text, "speed_m_s = 0.3");
  EXPECT_EQ(served.at("/parameters/index.json").text, R"(["robot","teleop"])");
  const auto parameters = nlohmann::json::parse(served.at("/parameters/robot.json").text);
  EXPECT_EQ(parameters["parameters"][0]["value"], 0.3);
  EXPECT_EQ(served.at("/parameters/teleop.json").text, R"({"table":0,"parameters":[]})");
}

TEST(StationFiles, LeaveOutATypeThatContainsItself) {
  const std::vector<bus::Schema::Source> sources{
      {"tree.lcm", "struct tree_t { int32_t n; tree_t child[n]; } struct leaf_t { int32_t n; }"}};
  const bus::Schema schema(sources);
  const StationFiles dut(schema);
  EXPECT_TRUE(dut.files().contains("/types/leaf_t.json"));
  EXPECT_FALSE(dut.files().contains("/types/tree_t.json"));
}

TEST(StationFiles, ParametersNeedTheTokenThatThePageNeeds) {
  StationFiles dut(bus::OwnTypes());
  dut.AddParameters({{"robot", {""}}});
  const WebAccess access{true, {{Role::kDriver, "driver-driver-driver"}}};
  const auto serves = [&](const std::string& target, const WebAccess& to) {
    return std::holds_alternative<ServeFile>(
        Answer({"GET", target, "localhost", "", false}, dut.files(), to));
  };
  EXPECT_TRUE(serves("/parameters/robot.toml", {}));
  EXPECT_FALSE(serves("/parameters/robot.toml", access));
  EXPECT_TRUE(serves("/parameters/robot.toml?token=driver-driver-driver", access));
}

}  // namespace
}  // namespace priamos::console
