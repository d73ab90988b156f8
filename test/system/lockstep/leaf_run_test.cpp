#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"
#include "common/geometry.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"

// The shipped door with its leaf at other angles, from the pictures to the end of the mission.

namespace priamos::cli {
namespace {

using ::testing::HasSubstr;

struct LeafRun {
  Summary summary;
  std::vector<door_seen_t> seen;  ///< looks that show a leaf
  double farthest_x_m = 0;
};

class LeafRunTest : public testing::Test {
 protected:
  LeafRun Run(double open_deg, const std::string& hinge, std::uint64_t seed) {
    const auto deployment = folder_.path() / fmt::format("{}-{}", hinge, open_deg);
    std::filesystem::copy(PRIAMOS_SOURCE_DIR "/config/sim", deployment,
                          std::filesystem::copy_options::recursive);
    Replace(deployment / "worlds/door.toml", "open_deg = 103\nopen_spread_deg = 11",
            fmt::format("open_deg = {}\nopen_spread_deg = 0", open_deg));
    Replace(deployment / "worlds/door.toml", "hinge = \"left\"", "hinge = \"" + hinge + "\"");
    LeafRun run;
    LockstepRequest request;
    request.deployment = deployment.string();
    request.seed = seed;
    request.tap = [&](std::string_view bus, Time, std::string_view channel, std::span<const std::byte> b) {
      if (bus != "onboard") return;
      if (channel == channels::kWorldTruth.name)
        run.farthest_x_m = std::max(run.farthest_x_m, bus::Decode<world_truth_t>(b).x_m);
      if (channel != channels::kDoorSeen.name) return;
      const auto seen = bus::Decode<door_seen_t>(b);
      if (seen.hinge != door_seen_t::NOT_SEEN) run.seen.push_back(seen);
    };
    run.summary = RunLockstep(schema_, request).summary;
    return run;
  }

  static void Replace(const std::filesystem::path& file, const std::string& from, const std::string& to) {
    std::stringstream content;
    content << std::ifstream(file).rdbuf();
    std::string text = content.str();
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(file) << text.replace(at, from.size(), to);
  }

  const bus::Schema schema_ = bus::OwnTypes();
  TemporaryFolder folder_;
};

TEST_F(LeafRunTest, ADoorThatIsHalfOpenIsRefusedAMetreBeforeIt) {
  for (const std::string hinge : {"left", "right"}) {
    const LeafRun dut = Run(45, hinge, 5);
    EXPECT_FALSE(dut.summary.passed);
    EXPECT_THAT(dut.summary.reason, HasSubstr("door 'laboratory' stands open only 45 degrees"));
    EXPECT_EQ(dut.summary.contacts, 0);
    EXPECT_LT(dut.farthest_x_m, 6 - 0.07 - 0.475 - 1) << hinge;
    ASSERT_GE(dut.seen.size(), 2u);
    for (const door_seen_t& seen : dut.seen) {
      EXPECT_EQ(seen.hinge, hinge == "left" ? door_seen_t::LEFT : door_seen_t::RIGHT);
      EXPECT_NEAR(Degrees(seen.open_rad), 45, 5);
    }
  }
}

TEST_F(LeafRunTest, ALeafThatIsSeenToLeaveTheWayFreeIsPassed) {
  const LeafRun dut = Run(92, "right", 6);
  EXPECT_TRUE(dut.summary.passed) << dut.summary.reason;
  EXPECT_EQ(dut.summary.contacts, 0);
  for (const door_seen_t& seen : dut.seen) EXPECT_NEAR(Degrees(seen.open_rad), 92, 5);
}

}  // namespace
}  // namespace priamos::cli
