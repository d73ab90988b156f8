#include <gtest/gtest.h>

#include "bus/log/clock_fit.hpp"
#include "bus/log/log_merge.hpp"
#include "bus/log/log_survey.hpp"
#include "bus/output_comparison.hpp"
#include "bus/own_types.hpp"
#include "bus/replay.hpp"
#include "cli/factories.hpp"

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
  for (const char* side : {"onboard", "offboard"}) {
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

}  // namespace
}  // namespace priamos
