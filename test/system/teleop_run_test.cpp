#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"
#include "test/support/temporary_folder.hpp"

// An operator's hand, the space-mouse, teleop, the radio, the robot and its world, in one process.

namespace priamos::cli {
namespace {

const std::string kShipped = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim";

LockstepResult RunScenario(const std::string& scenario, std::uint64_t seed,
                           const std::string& deployment = kShipped) {
  const bus::Schema schema = bus::OwnTypes();
  LockstepRequest request;
  request.deployment = deployment;
  request.scenario = scenario;
  request.seed = seed;
  return RunLockstep(schema, request);
}

void ExpectAGoodDrive(const LockstepResult& dut, double least_honoured) {
  SCOPED_TRACE(dut.summary.seed);
  EXPECT_TRUE(dut.summary.passed) << dut.summary.reason;
  EXPECT_EQ(dut.summary.contacts, 0);
  EXPECT_GT(dut.summary.min_gap_m, 0);
  ASSERT_TRUE(dut.summary.hand && dut.summary.hand->honoured());
  EXPECT_GT(*dut.summary.hand->honoured(), least_honoured);
}

/// The shipped deployment with other words in it.
class VariedDeployment {
 public:
  VariedDeployment() {
    std::filesystem::copy(kShipped, folder_ / "sim", std::filesystem::copy_options::recursive);
  }
  std::string path() const { return folder_ / "sim"; }
  void Replace(const std::string& file, const std::string& what, const std::string& by) {
    const std::string name = path() + "/" + file;
    std::stringstream text;
    text << std::ifstream(name).rdbuf();
    std::string content = text.str();
    const std::size_t at = content.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    std::ofstream(name) << content.replace(at, what.size(), by);
  }

 private:
  TemporaryFolder folder_;
};

TEST(TeleopRun, RoundTheCartonAndThroughThePassageByHand) {
  for (const std::uint64_t seed : {1u, 5u, 7u, 9u, 60001u, 60002u, 60003u, 60004u}) {
    const auto dut = RunScenario("teleop", seed);
    ExpectAGoodDrive(dut, 0.8);
    EXPECT_LT(dut.summary.hand->longest_stop_s.value_or(99), 2);
  }
}

TEST(TeleopRun, AHandThatIsNotExactGetsThereAsWell) {
  VariedDeployment varied;
  varied.Replace("scenarios/teleop.toml", "fast = true", "fast = true\nastray_deg = 30");
  // He pushes into the jambs himself, and stands there.
  varied.Replace("scenarios/teleop.toml", "longest_stop_s = 2", "longest_stop_s = 0");
  for (const std::uint64_t seed : {61001u, 61002u, 61003u})
    ExpectAGoodDrive(RunScenario("teleop", seed, varied.path()), 0.7);
}

TEST(TeleopRun, AnotherCartonAndANarrowerPassage) {
  VariedDeployment varied;
  varied.Replace("worlds/passage.toml", "x_m = 3.7\ny_m = 2.4\nlength_m = 0.40\nwidth_m = 0.40",
                 "x_m = 3.6\ny_m = 2.3\nlength_m = 0.60\nwidth_m = 0.30");
  varied.Replace("maps/passage.toml", "opening_width_m = 1.20", "opening_width_m = 1.10");
  varied.Replace("maps/passage.toml", "to_m = [6.0, 1.80]", "to_m = [6.0, 1.85]");
  varied.Replace("maps/passage.toml", "from_m = [6.0, 3.00]", "from_m = [6.0, 2.95]");
  for (const std::uint64_t seed : {62001u, 62002u, 62003u})
    ExpectAGoodDrive(RunScenario("teleop", seed, varied.path()), 0.8);
}

TEST(TeleopRun, AMonkeyAtTheStickTouchesNothingAndIsObeyed) {
  const auto dut = RunScenario("monkey", 1);
  ExpectAGoodDrive(dut, 0.6);
  EXPECT_GT(dut.summary.hand->wished_s, 30);
}

}  // namespace
}  // namespace priamos::cli
