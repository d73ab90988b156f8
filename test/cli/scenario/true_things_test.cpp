#include "cli/scenario/true_things.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "common/config.hpp"

namespace priamos::cli {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kDeployment = PRIAMOS_SOURCE_DIR "/config/sim";

GroundPlan Plan() {
  return LoadConfig<GroundPlan>(kDeployment + "/maps/door.toml");
}

world::Solid Box(const std::string& name, Pose2 at, Eigen::Vector2d size, double z_min, double z_max) {
  return {name, at, size, z_min, z_max, "furniture"};
}

std::vector<std::string> NamesOf(const std::vector<TrueThing>& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

TEST(TrueThings, OnlyWhatTheRobotCanTouchStandsInTheWay) {
  const TrueWorld world{
      {},
      {Box("carton", {3, 2, 0}, {0.4, 0.4}, 0, 0.5), Box("threshold", {6, 2.4, 0}, {0.1, 0.9}, 0, 0.008),
       Box("lamp", {3, 2, 0}, {0.4, 0.4}, 2.0, 2.2), Box("poster", {3, 0.07, 0}, {0.6, 0.004}, 1, 1.8)}};
  const auto dut = ThingsBeyond(Plan(), world);
  EXPECT_THAT(NamesOf(dut), testing::ElementsAre("carton"));
}

TEST(TrueThings, WhatThePlanShowsIsNoNews) {
  const GroundPlan plan = Plan();
  const Rectangle wall = plan.walls[0].Shape(), jamb = FrameShapes(plan.doors[0])[0];
  const auto solid = [](const Rectangle& shape) {
    return Box("x", shape.map_from_centre, 2 * shape.half_m, 0, 2);
  };
  EXPECT_THAT(ThingsBeyond(plan, TrueWorld{{}, {solid(wall), solid(jamb)}}), IsEmpty());
}

TEST(TrueThings, ADoorThatWasBuiltElsewhereIsShown) {
  Rectangle jamb = FrameShapes(Plan().doors[0])[0];
  jamb.map_from_centre.y += 0.02;
  const TrueWorld world{{}, {Box("d: left jamb", jamb.map_from_centre, 2 * jamb.half_m, 0, 2)}};
  EXPECT_THAT(NamesOf(ThingsBeyond(Plan(), world)), testing::ElementsAre("left jamb"));
}

TEST(TrueThings, OfAShippedWorldTheFurnitureAndTheLeafAreLeft) {
  const auto world = LoadTrueWorld(kDeployment, LoadScenario(kDeployment, "teleop"), 1);
  const auto dut = NamesOf(ThingsBeyond(LoadConfig<GroundPlan>(kDeployment + "/maps/passage.toml"), world));
  EXPECT_THAT(dut, Contains("carton in the way"));
  EXPECT_THAT(dut, Contains("leaf"));
  EXPECT_THAT(dut, Not(Contains(HasSubstr("wall"))));
  EXPECT_THAT(dut, Not(Contains(HasSubstr("jamb"))));
  EXPECT_THAT(ThingsBeyond(Plan(), {}), IsEmpty());
}

/// Those beside the door, not the others.
TEST(TrueThings, WallsAndJambsAreLeftWhereTheSurveyWasWrong) {
  const auto world = LoadTrueWorld(kDeployment, LoadScenario(kDeployment, "door"), 1);
  const auto dut = NamesOf(ThingsBeyond(LoadConfig<GroundPlan>(kDeployment + "/maps/door.toml"), world));
  EXPECT_THAT(dut, Contains(HasSubstr("jamb")));
  EXPECT_THAT(dut, Contains("wall left of the door"));
  for (const char* wall : {"wall north", "wall south", "wall west", "wall east"})
    EXPECT_THAT(dut, Not(Contains(wall)));
}

}  // namespace
}  // namespace priamos::cli
