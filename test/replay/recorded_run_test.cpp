#include <gmock/gmock.h>

#include <fstream>

#include "bus/log/clock_fit.hpp"
#include "bus/log/log_merge.hpp"
#include "bus/log/log_survey.hpp"
#include "bus/output_comparison.hpp"
#include "bus/own_types.hpp"
#include "bus/replay.hpp"
#include "cli/lockstep/factories.hpp"
#include "cli/report/report_files.hpp"
#include "cli/report/report_picture.hpp"
#include "common/config.hpp"
#include "common/drawing/svg.hpp"
#include "test/support/shell.hpp"
#include "test/support/svg_content.hpp"
#include "test/support/temporary_folder.hpp"

// One door run, recorded in lockstep and kept in logs/recorded: the robot and the planner do today what they
// did then, byte for byte.

namespace priamos {
namespace {

const std::string kSource = PRIAMOS_SOURCE_DIR;

std::string Log(const std::string& side) {
  return kSource + "/logs/recorded/door-" + side + ".lcmlog";
}

void ExpectReplayed(const std::string& module, const std::string& side, std::uint64_t messages) {
  const bus::Schema schema = bus::OwnTypes();
  const ConfigSource source{kSource + "/config/sim/" + module + ".toml", {}};
  bus::Replay replay(cli::FactoryFor(module), source, schema, Log(side), {source.Folder()});
  std::vector<bus::Output> replayed;
  replay.Run([&](const bus::Output& output) { replayed.push_back(output); });
  EXPECT_GT(replay.recorded().size(), messages);
  const auto comparison = bus::CompareOutputs(replay.recorded(), replayed, schema);
  std::string differences;
  for (const auto& line : comparison.differences) differences += line + "\n";
  EXPECT_TRUE(comparison.equal)
      << differences << "When " << module
      << " is meant to behave differently now: scripts/record-run makes the logs anew.";
}

TEST(RecordedRun, TheRobotDoesWhatItDid) {
  ExpectReplayed("robot", "onboard", 3000);
}

TEST(RecordedRun, ThePlannerDoesWhatItDid) {
  ExpectReplayed("planner", "offboard", 50);
}

TEST(RecordedRun, EveryMessageIsOfATypeWeStillHave) {
  const bus::Schema schema = bus::OwnTypes();
  for (const char* side : {"onboard", "offboard", "truth"}) {
    bus::LogReader reader(Log(side));
    const auto survey = bus::Survey(reader, schema);
    EXPECT_TRUE(survey.whole());
    EXPECT_EQ(survey.undecodable, 0u) << side << ": scripts/record-run makes the logs anew";
  }
}

/// Both hosts of a lockstep run share one clock: what the radio says of the clocks has to show it.
TEST(RecordedRun, TheRadioTellsThatBothClocksAreOne) {
  const bus::Schema schema = bus::OwnTypes();
  bus::LogReader onboard(Log("onboard")), offboard(Log("offboard"));
  const auto fit = bus::FitClocks(bus::FindStampPairs(onboard, offboard, schema));
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->pairs, 30u);
  EXPECT_TRUE(fit->both_ways);
  EXPECT_NEAR(fit->offset_us, 0, 5'000);
}

std::string FileText(const std::filesystem::path& file) {
  std::ifstream in(file);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// The picture of the door run whose logs lie in `folder`.
std::string PictureOf(const std::filesystem::path& folder, std::uint64_t seed) {
  cli::RunRecord record;
  for (const auto& [file, side] : {std::pair{"onboard", cli::Side::kOnboard},
                                   {"truth", cli::Side::kOnboard},
                                   {"offboard", cli::Side::kOffboard}}) {
    bus::LogReader reader(folder / (std::string("door-") + file + ".lcmlog"));
    while (const auto event = reader.Next()) record.Add(side, event->utime, event->channel, event->bytes);
  }
  const std::string deployment = kSource + "/config/sim";
  const auto scenario = cli::LoadScenario(deployment, "door");
  const std::string map = cli::MapFile(deployment, scenario);
  cli::RunInfo info;
  info.scenario = "door";
  info.seed = seed;
  info.door = cli::LoadDoor(map, scenario.landmark_id, true);
  info.world = cli::LoadTrueWorld(deployment, scenario, seed);
  return drawing::ToSvg(
      cli::DrawRun(record, cli::Summarise(record, info), info, LoadConfig<GroundPlan>(map)));
}

std::uint64_t SeedOf(const SvgContent& picture) {
  return std::stoull("0" + picture.TextThatBegins("door, seed ").substr(11));
}

/// In content: another version of the typeface may move its letters.
void ExpectSamePicture(const SvgContent& dut, const SvgContent& expected) {
  EXPECT_EQ(dut.texts, expected.texts);
  EXPECT_EQ(dut.layers, expected.layers);
  EXPECT_EQ(dut.paths, expected.paths);
}

TEST(RecordedRun, ThePictureOfTheReadmeIsThatOfItsLogs) {
  const std::filesystem::path folder = kSource + "/logs/recorded";
  EXPECT_THAT(FileText(kSource + "/README.md"), testing::HasSubstr("](logs/recorded/run.svg)"));
  const auto shown = ContentOf(FileText(folder / "run.svg"));
  ASSERT_NE(shown.TextThatBegins("door, seed "), "");
  SCOPED_TRACE("scripts/record-run makes logs/recorded/run.svg anew");
  ExpectSamePicture(ContentOf(PictureOf(folder, SeedOf(shown))), shown);
}

TEST(RecordedRun, TheScriptThatMakesItWorks) {
  const TemporaryFolder folder;
  const auto answer = RunShell(kSource + "/scripts/record-run --seed 2 --into " + folder.path().string() +
                               " --programs " PRIAMOS_BINARY_DIR "/bin");
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const auto made = ContentOf(FileText(folder / "run.svg"));
  EXPECT_EQ(SeedOf(made), 2u);
  ExpectSamePicture(ContentOf(PictureOf(folder.path(), 2)), made);
}

}  // namespace
}  // namespace priamos
