#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "radio/radio_app.hpp"
#include "test/bus/radio/measurement/command_measurement.hpp"

// Drive commands over two ends of the shipped link, in lockstep.

namespace priamos::radio {
namespace {

using bus::radio::LineConfig;

const std::string kConfig = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/";
constexpr double kTtl_s = 0.25;

/// Two ends of the radio; an operator's command every 50 ms, and every one that comes out on the robot's bus.
struct HeldLine {
  struct Obeyed {
    Time offered, stamp, at;
  };
  explicit HeldLine(const LineConfig& line) {
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", line);
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(bus::FactoryOf<RadioApp>(), side,
                      {kConfig + "radio.toml", {"side=" + side, "port=tty-" + side}});
    lockstep.SetTap([this](std::string_view bus, Time now, std::string_view channel, auto bytes) {
      if (bus != "onboard" || channel != channels::kDriveCommand.name) return;
      const auto command = bus::Decode<drive_command_t>(bytes);
      obeyed.push_back({offered.at(command.sequence), FromUtime(command.utime), now});
    });
  }
  void Run(double seconds) {
    auto drive = lockstep.DriverNode("offboard").Advertise(channels::kDriveCommand);
    const Time end = lockstep.now() + FromSeconds(seconds);
    while (lockstep.now() < end) {
      drive_command_t command{};
      command.utime = ToUtime(lockstep.now());
      command.sequence = ++sequence;
      command.time_to_live_s = kTtl_s;
      offered[sequence] = lockstep.now();
      drive.Publish(command);
      lockstep.RunUntil(lockstep.now() + FromSeconds(0.05));
    }
  }
  std::size_t Between(double from_s, double to_s) const {
    return static_cast<std::size_t>(std::count_if(obeyed.begin(), obeyed.end(), [&](const Obeyed& o) {
      return o.at >= start + FromSeconds(from_s) && o.at < start + FromSeconds(to_s);
    }));
  }

  bus::Schema schema = bus::OwnTypes();
  Time start = FromUtime(1'000'000'000);
  bus::Lockstep lockstep{schema, {.seed = 1, .start = start, .log = {}}};
  std::map<std::int32_t, Time> offered;
  std::vector<Obeyed> obeyed;
  std::int32_t sequence = 0;
};

TEST(CommandFreshness, AModemThatBeginsToHoldCommandsStopsTheRobotAndLetsItGoOnAfterwards) {
  LineConfig line;
  line.delays = {{"b_to_a", 8, 14, 0.8, 0.8}};
  HeldLine dut(line);
  dut.Run(18);
  EXPECT_GT(dut.Between(1, 8), 130U);
  EXPECT_EQ(dut.Between(8.3, 14), 0U);
  EXPECT_GT(dut.Between(15, 18), 55U);
  for (const HeldLine::Obeyed& o : dut.obeyed) {
    EXPECT_LE(Seconds(o.at - o.offered), kTtl_s);
    // The stamp of a wish travels in milliseconds, rounded.
    EXPECT_LE(o.stamp, o.offered + Duration(500));
  }
}

/// All that an operator's twenty commands a second must hold on the shipped link, every other channel at its
/// rate with its largest messages, stops left out: after one nobody drives.
TEST(CommandFreshness, OnABusyLineOfATenthOfASecondCommandsAreObeyed) {
  for (const auto& [up_s, down_s] : {std::pair{0.005, 0.005}, {0.05, 0.05}, {0.1, 0.0}, {0.0, 0.1}}) {
    const bus::radio::Obeyed dut =
        bus::radio::DriveRun({.up_s = up_s, .down_s = down_s, .jitter_s = 0.002}, 1).Run();
    RecordProperty(fmt::format("up_{}_down_{}_ms", 1000 * up_s, 1000 * down_s),
                   fmt::format("{} offered, {} obeyed, p95 {:.3f} s, longest gap {:.3f} s", dut.offered,
                               dut.took_s.size(), dut.quantile_s(0.95), dut.longest_gap_s));
    EXPECT_GT(dut.offered, 1190U);
    EXPECT_GE(dut.share(), 0.99) << up_s << " " << down_s;
    EXPECT_LE(dut.longest_gap_s, kTtl_s) << up_s << " " << down_s;
  }
}

}  // namespace
}  // namespace priamos::radio
