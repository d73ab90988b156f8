#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "cli/lockstep/factories.hpp"
#include "common/random.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"

// The shipped robot drives straight ahead in rooms with things that are not on its plan. The world judges
// what it touched, the robot's status whether it noticed.

namespace priamos {
namespace {

struct Thing {
  double x_m, y_m, yaw_deg, length_m, width_m, bottom_m, height_m;
  std::string material = "wood";
};

/// What a run brought.
struct Outcome {
  std::optional<Time> touched;  ///< by the world
  std::optional<Time> noticed;  ///< by the robot
  double end_x_m = 0;
};

class TouchRunTest : public testing::Test {
 protected:
  /// Orders a path of 3 m ahead at 0.4 m/s, and runs for 12 s; with `again` it is ordered under another
  /// number after every such time, as a mission does whose pose was corrected.
  Outcome Run(const Thing& thing, std::uint64_t seed, Duration again = FromSeconds(12)) {
    Outcome outcome;
    bus::Lockstep lockstep(schema_, {.seed = seed});
    lockstep.AddBus("onboard");
    lockstep.SetTap([&](std::string_view, Time now, std::string_view channel, std::span<const std::byte> b) {
      if (channel == channels::kWorldTruth.name) {
        const auto truth = bus::Decode<world_truth_t>(b);
        if (truth.contacts > 0 && !outcome.touched) outcome.touched = now;
        outcome.end_x_m = truth.x_m;
      } else if (channel == channels::kDriveStatus.name) {
        const auto status = bus::Decode<drive_status_t>(b);
        if (status.limit == drive_status_t::LIMIT_TOUCHED && !outcome.noticed) outcome.noticed = now;
      }
    });
    const std::string sim = PRIAMOS_SOURCE_DIR "/config/sim/";
    lockstep.AddApp(cli::FactoryFor("world"), "onboard", {sim + "world.toml", {"world=" + World(thing)}});
    lockstep.AddApp(cli::FactoryFor("robot"), "onboard", {sim + "robot.toml", {}});
    auto paths = lockstep.DriverNode("onboard").Advertise(channels::kPath);
    auto status = lockstep.DriverNode("onboard").Subscribe(channels::kDriveStatus);
    lockstep.RunUntil(lockstep.now() + FromSeconds(1));
    path_t path{};
    path.utime = ToUtime(lockstep.now());
    path.path_id = 1;
    path.speed_m_s = 0.4;
    path.estop_changes = status.get() ? status.get()->estop_changes : 0;
    path.points.resize(1);
    path.points[0].x_m = 5;
    path.points[0].y_m = 2.4;
    path.n_points = 1;
    for (const Time end = lockstep.now() + FromSeconds(12); lockstep.now() < end; ++path.path_id) {
      path.utime = ToUtime(lockstep.now());
      paths.Publish(path);
      lockstep.RunUntil(std::min(end, lockstep.now() + again));
    }
    return outcome;
  }

  std::string World(const Thing& t) {
    const std::string file = (folder_ / "world.toml").string();
    std::ofstream(file) << fmt::format(
        "map = \"{}/config/sim/maps/door.toml\"\n[start]\nx_m = 2.0\ny_m = 2.4\n[[boxes]]\nname = \"thing\"\n"
        "x_m = {}\ny_m = {}\nyaw_deg = {}\nlength_m = {}\nwidth_m = {}\nbottom_m = {}\nheight_m = {}\n"
        "material = \"{}\"\n",
        PRIAMOS_SOURCE_DIR, t.x_m, t.y_m, t.yaw_deg, t.length_m, t.width_m, t.bottom_m, t.height_m,
        t.material);
    return file;
  }

  const bus::Schema schema_ = bus::OwnTypes();
  TemporaryFolder folder_;
};

void ExpectNoticed(const Outcome& outcome, const std::string& what) {
  if (!outcome.touched) return;
  ASSERT_TRUE(outcome.noticed) << what;
  EXPECT_LE(Seconds(*outcome.noticed - *outcome.touched), 0.5) << what;
}

TEST_F(TouchRunTest, ATableTopIsTouchedAndNoticedByTheMotors) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng rng(seed);
    const Thing top{.x_m = rng.Uniform(3.4, 4.5),
                    .y_m = 2.4 + rng.Uniform(-0.3, 0.3),
                    .yaw_deg = rng.Uniform(-45, 45),
                    .length_m = 0.6,
                    .width_m = 1.0,
                    .bottom_m = rng.Uniform(0.5, 1.2),
                    .height_m = 0.04};
    const Outcome outcome = Run(top, seed);
    EXPECT_TRUE(outcome.touched) << "no sonar hears it";
    ExpectNoticed(outcome, fmt::format("seed {}", seed));
  }
}

TEST_F(TouchRunTest, ATouchIsToldAlthoughTheNextPathIsOnItsWay) {
  for (std::uint64_t seed = 2; seed <= 4; ++seed) {
    const Thing board{.x_m = 3.9 + 0.01 * double(seed),
                      .y_m = 1.93,
                      .yaw_deg = -8,
                      .length_m = 0.7,
                      .width_m = 0.7,
                      .bottom_m = 0.91,
                      .height_m = 0.05};
    const Outcome outcome = Run(board, seed, FromSeconds(0.06));
    EXPECT_TRUE(outcome.touched);
    ExpectNoticed(outcome, fmt::format("seed {}", seed));
  }
}

TEST_F(TouchRunTest, APostAPartitionOrAFinIsNotTouchedOrItIsNoticed) {
  int touched = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Rng rng(seed);
    const double size = rng.Uniform(0.02, 0.15);
    const bool post = seed % 2 == 0;
    const Thing thing{.x_m = rng.Uniform(3.2, 4.5),
                      .y_m = 2.4 + rng.Uniform(-0.42, 0.42),
                      .yaw_deg = rng.Uniform(-60, 60),
                      .length_m = post ? size : rng.Uniform(0.5, 1.5),
                      .width_m = post ? size : 0.03,
                      .bottom_m = 0,
                      .height_m = 1.5,
                      .material = "metal"};
    const Outcome outcome = Run(thing, seed);
    touched += outcome.touched.has_value();
    ExpectNoticed(outcome, fmt::format("seed {}", seed));
  }
  RecordProperty("touched", touched);
}

TEST_F(TouchRunTest, WhereNothingStandsNothingIsNoticed) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Outcome outcome = Run({8, 4, 0, 0.1, 0.1, 0, 1}, seed);
    EXPECT_FALSE(outcome.touched);
    EXPECT_FALSE(outcome.noticed) << "seed " << seed;
    EXPECT_GT(outcome.end_x_m, 4.0);
  }
}

}  // namespace
}  // namespace priamos
