#include "world/world_loading.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/archive.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"
#include "world/core/scene/outline.hpp"

namespace priamos::world {
namespace {

const std::string kFolder = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/";

std::string InShipped(const std::string& name) {
  return kFolder + name;
}

class ShippedWorldTest : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedWorldTest, LoadsForManySeeds) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const LoadedWorld dut = LoadWorld(GetParam(), InShipped, Body{}, seed);
    EXPECT_GT(Clearance(Body{}, dut.solids).Gap(dut.start.truth, 1), 0.1) << seed;
  }
}

/// Smallest gap of the footprint on its way along the axis of the door as built, from as far as the nominal
/// start to 1.5 m behind it.
double GapOnTheWay(const LoadedWorld& world) {
  const DoorPlan& door = world.doors.front();
  const Clearance clearance(Body{}, world.solids);
  double gap = 10;
  const double begin = (door.map_from_door().Inverse() * world.start.nominal).x;
  for (double x = begin; x < 1.5; x += 0.02)
    gap = std::min(gap, clearance.Gap(door.map_from_door() * Pose2{x, 0, 0}, 10));
  return gap;
}

/// Those in which somebody drives.
class DoorWorldTest : public ShippedWorldTest {};

TEST_P(DoorWorldTest, LeavesTheWayThroughTheDoorFreeUnlessItsNameSaysOtherwise) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const LoadedWorld dut = LoadWorld(GetParam(), InShipped, Body{}, seed);
    const double gap = GapOnTheWay(dut);
    if (GetParam().find("blocked") != std::string::npos || GetParam().find("detour") != std::string::npos) {
      EXPECT_EQ(gap, 0) << seed;
    } else {
      EXPECT_NEAR(gap, (dut.doors.front().opening_width_m - 0.78) / 2, 1e-9) << seed;
    }
  }
}

TEST_P(DoorWorldTest, StartsThreeToFiveMetresBeforeTheDoor) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const LoadedWorld dut = LoadWorld(GetParam(), InShipped, Body{}, seed);
    const Pose2 in_door = dut.map.doors.front().map_from_door().Inverse() * dut.start.truth;
    EXPECT_GE(-in_door.x, 3);
    EXPECT_LE(-in_door.x, 5);
    EXPECT_LE((dut.start.nominal.translation() - dut.start.truth.translation()).norm(), 0.2);
  }
}

std::vector<std::string> ShippedWorlds(const std::string& begin) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder + "worlds")) {
    const std::string name = entry.path().filename();
    if (name.starts_with(begin)) names.push_back("worlds/" + name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string TestName(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = std::filesystem::path(info.param).stem();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedWorldTest, ::testing::ValuesIn(ShippedWorlds("")), TestName);
INSTANTIATE_TEST_SUITE_P(All, DoorWorldTest, ::testing::ValuesIn(ShippedWorlds("door")), TestName);

TEST(LoadWorldTest, TheCalibrationBodyStandsBeforeTheCameras) {
  const LoadedWorld dut = LoadWorld("worlds/calibration.toml", InShipped, Body{}, 1);
  ASSERT_TRUE(dut.reference);
  EXPECT_GE(dut.reference->object.discs.size(), 16u);
  const Pose2 base = dut.start.truth;
  const Eigen::Vector3d in_map = dut.reference->map_from_object.translation();
  EXPECT_NEAR((base.Inverse() * Eigen::Vector2d(in_map.x(), in_map.y())).x(), 2.05, 0.005);
  EXPECT_NEAR(in_map.z(), 1.2, 0.005);
}

class BadWorldTest : public ::testing::Test {
 protected:
  std::string ErrorOf(const std::string& world) {
    std::ofstream(folder_ / "map.toml") << "[[walls]]\nname = \"w\"\nfrom_m = [0, 3]\nto_m = [5, 3]\n";
    std::ofstream(folder_ / "world.toml") << "map = \"map.toml\"\n" << world;
    try {
      LoadWorld(
          "world.toml", [this](const std::string& name) { return (folder_ / name).string(); }, Body{}, 1);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }
  const TemporaryFolder folder_;
};

TEST_F(BadWorldTest, AGoodOneLoads) {
  EXPECT_EQ(ErrorOf(""), "");
}

TEST_F(BadWorldTest, AnUnknownMaterialIsNamed) {
  EXPECT_THAT(ErrorOf("[[boxes]]\nname = \"lump\"\nx_m = 9\nmaterial = \"jelly\"\n"),
              ::testing::AllOf(::testing::HasSubstr("world.toml:5:boxes[0].material: expected one of"),
                               ::testing::HasSubstr("got \"jelly\"")));
}

TEST_F(BadWorldTest, AStartInsideABoxIsRefused) {
  EXPECT_THAT(ErrorOf("[[boxes]]\nx_m = 0\n"), ::testing::HasSubstr("expected a free place"));
}

TEST_F(BadWorldTest, AMissingMapIsNamed) {
  EXPECT_THAT(ErrorOf("").empty() ? "" : "?", "");
  std::ofstream(folder_ / "other.toml") << "\nmap = \"nowhere.toml\"\n";
  EXPECT_THAT(support::ThrownReason([&] {
                LoadWorld(
                    "other.toml", [this](const std::string& n) { return (folder_ / n).string(); }, Body{}, 1);
              }),
              ::testing::HasSubstr("other.toml:2:map: expected a file, got none"));
}

TEST_F(BadWorldTest, WhatContradictsTheMapOrItselfIsRefused) {
  using ::testing::HasSubstr;
  EXPECT_THAT(
      ErrorOf("[[posters]]\nwall = \"attic\"\n"),
      HasSubstr("world.toml:3:posters[0].wall: expected the name of a wall of the map, got \"attic\""));
  EXPECT_THAT(ErrorOf("[[posters]]\nwall = \"w\"\nwidth_m = 2\nalong_m = 4.5\n"),
              HasSubstr("world.toml:5:posters[0].along_m: expected a poster of 2.00 m to hang on \"w\""));
  EXPECT_EQ(ErrorOf("[[posters]]\nwall = \"w\"\nwidth_m = 2\nalong_m = 4\n"), "");
  EXPECT_THAT(ErrorOf("[[surfaces]]\nwall = \"w\"\n[[surfaces]]\nwall = \"w\"\n"),
              HasSubstr("world.toml:5:surfaces[1].wall: expected one surface per wall"));
  EXPECT_THAT(ErrorOf("[[doors]]\nid = 7\n"),
              HasSubstr("world.toml:3:doors[0].id: expected the id of a door of the map, got 7"));
  EXPECT_THAT(ErrorOf("[reference]\nobject = \"nothing.toml\"\n"),
              HasSubstr("world.toml:3:reference.object: expected a file, got none"));
  EXPECT_THAT(ErrorOf("[[people]]\n[[people.waypoints]]\nx_m = 0.1\ny_m = 0\n"),
              HasSubstr("world.toml:2: people: expected \"person\" beside the robot"));
}

TEST(LoadWorldTest, ADoorIsListedOnce) {
  const TemporaryFolder folder;
  std::ifstream shipped(InShipped("worlds/door.toml"));
  std::ofstream(folder / "twice.toml") << shipped.rdbuf() << "\n[[doors]]\nid = 1\n";
  const auto resolve = [&](const std::string& name) {
    return name == "twice.toml" ? std::string(folder / name) : InShipped(name);
  };
  EXPECT_THAT(support::ThrownReason([&] { LoadWorld("twice.toml", resolve, Body{}, 1); }),
              ::testing::HasSubstr("expected each door once, got 1 twice"));
}

TEST_F(BadWorldTest, PeopleAndHolesAreCheckedWithTheirPlaceInTheFile) {
  EXPECT_THAT(ErrorOf("[[people]]\n[[people.waypoints]]\nx_m = 2\ny_m = 2.9\n"),
              ::testing::AllOf(::testing::HasSubstr("world.toml:2: people: expected 0.25 m of room"),
                               ::testing::HasSubstr("got \"wall w\"")));
  EXPECT_THAT(ErrorOf("[[people]]\nname = \"x\"\n"),
              ::testing::HasSubstr("at least one [[people.waypoints]]"));
  EXPECT_THAT(ErrorOf("[[people]]\nspeed_m_s = 2\n"),
              ::testing::HasSubstr("world.toml:3:people[0].speed_m_s"));
  EXPECT_THAT(ErrorOf("[[holes]]\nname = \"pit\"\n"),
              ::testing::HasSubstr("world.toml:2: holes: expected floor below the start, got \"pit\""));
  EXPECT_THAT(ErrorOf("[[faults.sonars]]\nsensor = 25\n"),
              ::testing::HasSubstr("world.toml:3:faults.sonars[0].sensor"));
  EXPECT_THAT(ErrorOf("[[faults.motors]]\nkind = \"melted\"\n"),
              ::testing::HasSubstr("world.toml:3:faults.motors[0].kind"));
  EXPECT_THAT(ErrorOf("[cameras]\ngain_spread = 2\n"),
              ::testing::HasSubstr("world.toml:3:cameras.gain_spread"));
  EXPECT_THAT(ErrorOf("[mast]\nnod_deg_s2_m = 20\n"), ::testing::HasSubstr("world.toml:3:mast.nod_deg_s2_m"));
}

TEST_F(BadWorldTest, AGridOfNoFileIsRefusedAndNotWaitedFor) {
  using ::testing::HasSubstr;
  EXPECT_THAT(ErrorOf("[grid]\nyaml = \".\"\n"),
              HasSubstr("world.toml:2: grid.yaml: expected a file, got a folder"));
  std::ofstream(folder_ / "grid.yaml") << "image: pipe\nresolution: 0.05\norigin: [0, 0, 0]\n";
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(ErrorOf("[grid]\nyaml = \"grid.yaml\"\n"), HasSubstr("image: expected a file, got a pipe"));
  std::ofstream(folder_ / "grid.yaml") << "image: /dev/zero\nresolution: 0.05\norigin: [0, 0, 0]\n";
  EXPECT_THAT(ErrorOf("[grid]\nyaml = \"grid.yaml\"\n"), HasSubstr("image: expected a file, got a device"));
}

}  // namespace
}  // namespace priamos::world
