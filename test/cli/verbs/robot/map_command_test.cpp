#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/config.hpp"
#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"
#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A learned map with a doorway in a wall that is not on the plan.
class MapCommand : public testing::Test {
 protected:
  MapCommand() {
    LearnedWalls learned;
    for (int i = 0; i < 2; ++i) {
      LearnedWall wall;
      wall.id = i + 1;
      wall.x_m = 3;
      wall.y_m = 1 + 2.5 * i;
      wall.yaw_deg = 90;
      wall.length_m = 1.5;
      wall.sigma_across_m = 0.02;
      wall.sigma_yaw_deg = 0.5;
      wall.seen_s = 1000;
      learned.walls.push_back(wall);
    }
    LearnedObject box;
    box.id = 3;
    box.kind = "box";
    box.x_m = 4;
    box.y_m = 2;
    box.width_m = 0.6;
    box.depth_m = 0.4;
    box.top_m = 1.1;
    learned.objects = {box};
    box.id = 4;
    box.kind = "edge";
    box.x_m = 5;
    learned.objects.push_back(box);
    learned.points = {{3, 0.2, 0.02, 1000, 7}};
    SaveLearnedWalls(file_, learned);
  }
  PriamosAnswer Map(std::vector<std::string> more) {
    std::vector<std::string> words{"map", "--deployment", PRIAMOS_SOURCE_DIR "/config/sim", "--logs",
                                   folder_.path().string()};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  TemporaryFolder folder_;
  std::string file_ = (folder_ / "learned.toml").string();
};

TEST_F(MapCommand, ShowsPlanAndLearnedWalls) {
  const auto answer = Map({"--file", file_});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.err, "");
  EXPECT_THAT(answer.out, HasSubstr("wall 1   (3.00, 0.25)  (3.00, 1.75)"));
  EXPECT_THAT(answer.out, HasSubstr("gap 1-2"));
  EXPECT_THAT(answer.out, HasSubstr("thing 3  (4.00, 2.00)  box"));
  EXPECT_THAT(answer.out, HasSubstr("point 7  (3.00, 0.20)"));
  EXPECT_THAT(answer.out, HasSubstr("⠒")) << "a picture of dots";
}

TEST_F(MapCommand, JsonHoldsWallsAndGaps) {
  const auto lines = LinesOf(Map({"--file", file_, "--json"}).out);
  ASSERT_EQ(lines.size(), 1u);
  const json map = json::parse(lines[0]);
  EXPECT_EQ(map["walls"].size(), 2u);
  EXPECT_NEAR(map["walls"][0]["to_m"][1].get<double>(), 1.75, 1e-9);
  ASSERT_EQ(map["gaps"].size(), 1u);
  EXPECT_NEAR(map["gaps"][0]["width_m"].get<double>(), 1.0, 1e-9);
  ASSERT_EQ(map["points"].size(), 1u);
  EXPECT_EQ(map["points"][0]["at_m"][0], 3);
  ASSERT_EQ(map["things"].size(), 2u);
  EXPECT_EQ(map["things"][0]["kind"], "box");
  EXPECT_EQ(map["things"][0]["front_m"][0], 4);
  EXPECT_EQ(map["things"][0]["depth_m"], 0.4);
}

TEST_F(MapCommand, DrawsItIntoAFile) {
  const std::string svg = (folder_ / "map.svg").string();
  EXPECT_EQ(Map({"--file", file_, "--svg", svg}).exit_code, 0);
  const std::string content = FileContent(svg);
  EXPECT_THAT(content, HasSubstr("<svg"));
  for (const char* layer :
       {"class=\"wall\"", "class=\"learned-wall\"", "class=\"learned-sigma\"", "class=\"gap\"",
        "class=\"learned-point\"", "class=\"seen-thing\"", "class=\"seen-edge\""})
    EXPECT_THAT(content, HasSubstr(layer));
  EXPECT_THAT(content, HasSubstr("0.60 x 0.40 m, 1.1 m high"));
  const auto refused = Map({"--file", file_, "--svg", (folder_ / "no" / "map.svg").string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--svg: expected a file that can be written"));
}

TEST_F(MapCommand, ExportsAPlanThatAPlannerReads) {
  const std::string into = (folder_ / "plan.toml").string(), sim = PRIAMOS_SOURCE_DIR "/config/sim";
  const auto answer = Priamos({"map", "export", into, "--file", file_, "--deployment", sim});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("plan.toml: 2 walls, 0 doors")) << "a gap of 1 m is wide enough";
  const auto plan = LoadConfig<GroundPlan>(into);
  ASSERT_EQ(plan.walls.size(), 2u);
  EXPECT_NEAR(plan.walls[0].from().y(), 0.25, 1e-6);
  const auto nothing =
      Priamos({"map", "export", into, "--deployment", sim, "--logs", folder_.path().string()});
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_THAT(nothing.err, HasSubstr("nothing has been learned"));
  const auto nowhere = Priamos({"map", "export", into + "/x", "--file", file_, "--deployment", sim});
  EXPECT_EQ(nowhere.exit_code, 2);
}

TEST_F(MapCommand, ExportsGridsAndDrawingsAndTheSurveyedPlan) {
  const std::string sim = PRIAMOS_SOURCE_DIR "/config/sim";
  const auto into = [&](const char* name) { return (folder_ / name).string(); };
  const auto grid = Priamos({"map", "export", into("map.yaml"), "--file", file_, "--deployment", sim});
  EXPECT_EQ(grid.exit_code, 0) << grid.err;
  EXPECT_THAT(FileContent(into("map.yaml")), HasSubstr("image: map.pgm\nresolution: 0.050\n"));
  EXPECT_THAT(FileContent(into("map.pgm")), testing::StartsWith("P5\n"));
  const auto drawn = Priamos({"map", "export", into("plan.svg"), "--surveyed", "--deployment", sim});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_THAT(FileContent(into("plan.svg")), HasSubstr("class=\"wall\""));
  const auto plan = Priamos({"map", "export", into("plan.toml"), "--surveyed", "--deployment", sim});
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  EXPECT_EQ(LoadConfig<GroundPlan>(into("plan.toml")).walls.size(),
            LoadConfig<GroundPlan>(sim + "/maps/door.toml").walls.size());
  const auto other = Priamos({"map", "export", into("plan.png"), "--surveyed", "--deployment", sim});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, HasSubstr("into: expected a file called *.toml, *.svg or *.yaml, got"));
}

TEST_F(MapCommand, WhereNothingWasLearnedItSaysSo) {
  const auto answer = Map({});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_THAT(answer.err, HasSubstr("nothing has been learned of this building"));
  EXPECT_THAT(answer.err, HasSubstr("; next: "));
  EXPECT_THAT(answer.out, HasSubstr("⠒")) << "the plan is shown";
}

TEST_F(MapCommand, AFileThatIsNotThereOrDamagedIsRefused) {
  const auto missing = Map({"--file", (folder_ / "none.toml").string()});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("--file: expected a learned map"));
  std::ofstream(file_) << "version = 9\n";
  const auto damaged = Map({"--file", file_});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("learned.toml:1:version"));
}

TEST_F(MapCommand, AnEntryWithoutItsKeysIsRefused) {
  std::ofstream(file_) << "version = 1\n[[points]]\nx_m = 1\n";
  const auto damaged = Map({"--file", file_});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.err,
              HasSubstr("learned.toml:2:points[0].id: expected the number of the point, got none"));
}

TEST_F(MapCommand, PointsAloneAreAMap) {
  LearnedWalls learned;
  learned.points = {{3, 0.2, 0.02, 1000, 1}};
  SaveLearnedWalls(file_, learned);
  EXPECT_EQ(Map({"--file", file_}).exit_code, 0);
}

TEST_F(MapCommand, AWordTooMuchIsRefused) {
  EXPECT_EQ(Map({"rest"}).exit_code, 2);
}

TEST_F(MapCommand, ResetNeedsAPlannerThatSpeaks) {
  MessageLog log((folder_ / "bus.lcmlog").string());
  log.Add(0, "POSE", pose_t{});
  const auto silent = Priamos({"map", "reset", "--bus", log.url()});
  EXPECT_EQ(silent.exit_code, 1);
  EXPECT_THAT(silent.err, HasSubstr("MISSION_STATUS"));
}

}  // namespace
}  // namespace priamos::cli
