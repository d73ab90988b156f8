#include <gtest/gtest.h>

#include <vector>

#include "bus/lockstep.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "cli/factories.hpp"
#include "lcmtypes/channels.hpp"

// The head of the shipped deployment watches the laser's line in the simulated world.

namespace priamos {
namespace {

class LaserRunTest : public testing::Test {
 protected:
  /// What the head told of the floor in the first seconds.
  std::vector<obstacle_line_t> Watch(const std::string& world, double seconds) {
    std::vector<obstacle_line_t> lines;
    bus::Lockstep lockstep(schema_, {.seed = 3});
    lockstep.AddBus("onboard");
    lockstep.SetTap([&](std::string_view, Time, std::string_view channel, std::span<const std::byte> bytes) {
      if (channel == channels::kObstacleLine.name) lines.push_back(bus::Decode<obstacle_line_t>(bytes));
    });
    const std::string sim = PRIAMOS_SOURCE_DIR "/config/sim/";
    lockstep.AddApp(cli::FactoryFor("world"), "onboard", {sim + "world.toml", {"world=worlds/" + world}});
    lockstep.AddApp(cli::FactoryFor("head"), "onboard", {sim + "head.toml", {"laser.rate_hz=2"}});
    lockstep.RunUntil(lockstep.now() + FromSeconds(seconds));
    return lines;
  }

  const bus::Schema schema_ = bus::OwnTypes();
};

TEST_F(LaserRunTest, ADuctOfThreeCentimetresIsToldWhereItLies) {
  const auto lines = Watch("sill.toml", 4.5);
  ASSERT_GE(lines.size(), 2u);
  for (const obstacle_line_t& line : lines) {
    ASSERT_EQ(line.verdict, obstacle_line_t::OBSTACLE);
    EXPECT_GT(line.seen_share, 0.9);
    ASSERT_EQ(line.n_segments, 1);
    const obstacle_segment_t& duct = line.segments[0];
    EXPECT_EQ(duct.kind, obstacle_segment_t::UP);
    EXPECT_NEAR(duct.height_m, 0.03, 3 * duct.sigma_height_m);
    EXPECT_NEAR(duct.y1_m, -0.40, 0.02);
    EXPECT_NEAR(duct.y2_m, 0.0, 0.02);
    EXPECT_NEAR((duct.x1_m + duct.x2_m) / 2, 2.02, 0.03);
  }
}

TEST_F(LaserRunTest, AFloorWithoutAnythingIsClear) {
  const auto lines = Watch("door.toml", 4.5);
  ASSERT_GE(lines.size(), 2u);
  for (const obstacle_line_t& line : lines) EXPECT_EQ(line.verdict, obstacle_line_t::CLEAR);
}

}  // namespace
}  // namespace priamos
