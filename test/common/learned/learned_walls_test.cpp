#include "common/learned/learned_walls.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos {
namespace {

using support::ThrownReason;
using testing::HasSubstr;

LearnedWalls Some() {
  LearnedWalls walls;
  walls.revision = 41;
  LearnedWall wall;
  wall.id = 3;
  wall.x_m = 1.25;
  wall.y_m = -0.1;
  wall.yaw_deg = 89.5;
  wall.length_m = 2.5;
  wall.sigma_across_m = 0.02;
  wall.sigma_yaw_deg = 0.4;
  wall.rho = -0.5;
  wall.sigma_end_m = 0.1;
  wall.seen_s = 1764028800.25;
  wall.sightings = 4;
  walls.walls = {wall};
  return walls;
}

class LearnedWallsTest : public testing::Test {
 protected:
  std::string Refused(const std::string& content) {
    std::ofstream(file_) << content;
    return ThrownReason([&] { LoadLearnedWalls(file_); });
  }
  TemporaryFolder folder_;
  std::string file_ = (folder_ / std::string(kLearnedMapFile)).string();
};

TEST_F(LearnedWallsTest, AFileHoldsWhatWasWritten) {
  ASSERT_TRUE(SaveLearnedWalls(file_, Some()));
  const LearnedWalls dut = LoadLearnedWalls(file_);
  EXPECT_EQ(dut.revision, 41);
  ASSERT_EQ(dut.walls.size(), 1u);
  EXPECT_EQ(dut.walls[0].id, 3);
  EXPECT_EQ(dut.walls[0].seen_s, 1764028800.25);
  EXPECT_EQ(dut.walls[0].rho, -0.5);
  EXPECT_EQ(dut.walls[0].sightings, 4);
  ASSERT_TRUE(SaveLearnedWalls(file_, LearnedWalls{}));
  EXPECT_TRUE(LoadLearnedWalls(file_).walls.empty());
}

TEST_F(LearnedWallsTest, DoorsAreKeptAndNamedByThePlan) {
  LearnedWalls walls = Some();
  LearnedDoor door;
  door.id = 7;
  door.x_m = 6.1;
  door.y_m = 1.1;
  door.state = "ajar";
  door.looks = 3;
  walls.doors = {door};
  ASSERT_TRUE(SaveLearnedWalls(file_, walls));
  const LearnedWalls dut = LoadLearnedWalls(file_);
  ASSERT_EQ(dut.doors.size(), 1u);
  EXPECT_EQ(dut.doors[0].x_m, 6.1);
  EXPECT_EQ(dut.doors[0].state, "ajar");
  EXPECT_EQ(dut.doors[0].looks, 3);
  GroundPlan plan;
  EXPECT_EQ(NameOf(dut.doors[0], plan), "door 7");
  plan.doors.push_back({});
  plan.doors[0].name = "office";
  plan.doors[0].x_m = 6;
  plan.doors[0].y_m = 1.17;
  EXPECT_EQ(NameOf(dut.doors[0], plan), "door 'office'");
}

TEST_F(LearnedWallsTest, ThingsAreKept) {
  LearnedWalls walls = Some();
  LearnedObject object;
  object.id = 5;
  object.kind = "box";
  object.x_m = 6.1;
  object.y_m = 1.1;
  object.yaw_deg = -90;
  object.width_m = 0.6;
  object.depth_m = 0.4;
  object.top_m = 1.12;
  object.sigma_across_m = 0.015;
  object.looks = 3;
  walls.objects = {object};
  ASSERT_TRUE(SaveLearnedWalls(file_, walls));
  const LearnedWalls dut = LoadLearnedWalls(file_);
  ASSERT_EQ(dut.objects.size(), 1u);
  EXPECT_EQ(dut.objects[0].id, 5);
  EXPECT_EQ(dut.objects[0].kind, "box");
  EXPECT_EQ(dut.objects[0].yaw_deg, -90);
  EXPECT_EQ(dut.objects[0].depth_m, 0.4);
  EXPECT_EQ(dut.objects[0].top_m, 1.12);
  EXPECT_EQ(dut.objects[0].sigma_across_m, 0.015);
  EXPECT_EQ(dut.objects[0].looks, 3);
}

TEST_F(LearnedWallsTest, AFileFromBeforeThereWereThingsIsRead) {
  std::ofstream(file_) << "version = 1\nrevision = 4\n[[walls]]\nid = 1\nx_m = 2\ny_m = 1\n";
  const LearnedWalls dut = LoadLearnedWalls(file_);
  EXPECT_EQ(dut.walls.size(), 1u);
  EXPECT_TRUE(dut.objects.empty());
}

TEST_F(LearnedWallsTest, NoFileIsAnEmptyMap) {
  EXPECT_TRUE(LoadLearnedWalls(file_).walls.empty());
}

TEST_F(LearnedWallsTest, AFileThatCannotBeWrittenIsTold) {
  EXPECT_FALSE(SaveLearnedWalls((folder_ / "missing" / "map.toml").string(), Some()));
}

TEST_F(LearnedWallsTest, DamagedFilesAreRefusedWithTheirLine) {
  EXPECT_THAT(Refused("version = 2\n"),
              HasSubstr("learned-map.toml:1:version: expected a whole number, 1 to 1"));
  EXPECT_THAT(Refused("revision = 4\n"), HasSubstr("version: expected 1, the version of the file's form"));
  EXPECT_THAT(Refused("version = 1\nwall = 3\n"), HasSubstr("learned-map.toml:2:"));
  EXPECT_THAT(Refused("version = 1\n[[walls]]\nid = 1\nx_m = nan\n"),
              HasSubstr("learned-map.toml:4:walls[0].x_m"));
  for (const std::string list : {"walls", "doors", "objects", "points"}) {
    const std::string known = list == "points" ? "sigma_m = 0.02\n" : "";
    const std::string one = "[[" + list + "]]\nid = 1\nx_m = 0\ny_m = 0\n" + known;
    EXPECT_THAT(Refused("version = 1\n" + one + one), HasSubstr("with its own id, not 1 twice")) << list;
    const std::string key = "learned-map.toml:2:" + list + "[0].";
    EXPECT_THAT(Refused("version = 1\n[[" + list + "]]\n"), HasSubstr(key + "id: expected the number of"));
    EXPECT_THAT(Refused("version = 1\n[[" + list + "]]\nid = 1\nx_m = 2\n"),
                HasSubstr(key + "y_m: expected a place, x_m and y_m, got none"));
  }
  EXPECT_THAT(Refused("version = 1\n[[points]]\nid = 1\nx_m = 201\n"),
              HasSubstr("learned-map.toml:4:points[0].x_m: expected"));
  EXPECT_THAT(Refused("version = 1\n[[points]]\nid = 1\nx_m = 2\ny_m = 1\n"),
              HasSubstr("learned-map.toml:2:points[0].sigma_m: expected how well its place is known"))
      << "a file that was cut off";
  EXPECT_THAT(Refused("version = 1\n[[objects]]\nid = 1\nkind = \"tree\"\n"),
              HasSubstr("learned-map.toml:4:objects[0].kind"));
  EXPECT_THAT(Refused("version = "), HasSubstr("learned-map.toml:1"));
}

RC_GTEST_PROP(LearnedWall, TheCovarianceSurvivesItsNumbers, ()) {
  LearnedWall dut = Some().walls[0];
  dut.sigma_across_m = *rc::gen::inRange(0, 100) / 100.0;
  dut.sigma_yaw_deg = *rc::gen::inRange(0, 100) / 10.0;
  dut.rho = *rc::gen::inRange(-10, 11) / 10.0;
  const Eigen::Matrix2d before = dut.covariance();
  dut.SetCovariance(before);
  RC_ASSERT((dut.covariance() - before).norm() < 1e-9);
  RC_ASSERT(std::abs(dut.SigmaAt(0) - dut.sigma_across_m) < 1e-9);
}

}  // namespace
}  // namespace priamos
