#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "bus/radio/link_config.hpp"
#include "common/config.hpp"
#include "radio/radio_app.hpp"
#include "test/bus/radio/measurement/numbered_message.hpp"

// Drive commands over two ends of the shipped link, in lockstep.

namespace priamos::radio {
namespace {

using bus::radio::ChannelClass;
using bus::radio::LineConfig;
using bus::radio::LinkChannel;

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

/// What became of the drive commands on the shipped link, with every channel as busy as it may be.
struct Share {
  std::size_t offered = 0, sent = 0, obeyed = 0;
};

std::vector<LinkChannel> ShippedChannels() {
  const auto config = LoadConfig<bus::radio::LinkConfig>(kConfig + "link.toml");
  const auto table = config.Table(bus::OwnTypes());
  std::vector<LinkChannel> channels = table.channels();
  for (LinkChannel& c : channels) {
    // The messages of LinkPair are whole bytes.
    c.fixed_bits = (c.fixed_bits + 7) / 8 * 8;
    c.max_bits = (c.max_bits + 7) / 8 * 8;
    c.delta.clear();
  }
  return channels;
}

Share DriveOnABusyLink(double up_s, double down_s, std::uint64_t seed) {
  const auto config = LoadConfig<bus::radio::LinkConfig>(kConfig + "link.toml");
  LineConfig line{.latency_s = 0};
  line.delays = {{"a_to_b", 0, 1e6, up_s, up_s}, {"b_to_a", 0, 1e6, down_s, down_s}};
  bus::radio::LinkPair pair(line, seed, config.Options());
  pair.onboard.channels = pair.offboard.channels = ShippedChannels();
  pair.Start(pair.onboard);
  pair.Start(pair.offboard);
  const auto& channels = pair.onboard.channels;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].on_request) pair.offboard.link->Listen(i, true);
  pair.Run(1.5);
  Rng rng = Rng::Stream(seed, "offers");
  std::vector<Time> next(channels.size(), pair.now);
  std::size_t drive = 0;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name == channels::kDriveCommand.name) drive = i;
  Share share;
  pair.each_step = [&] {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const LinkChannel& c = channels[i];
      if (c.urgent || pair.now < next[i]) continue;  // after an e-stop nobody drives
      next[i] += FromSeconds(i == drive ? 1 / c.rate_hz : rng.Uniform(1, 1.2) / c.rate_hz / c.max_keys);
      auto& end = c.direction == bus::radio::Direction::kUp ? pair.onboard : pair.offboard;
      end.link->Offer(i, bus::radio::NumberedMessage(7, c.max_bits / 8), pair.now,
                      std::to_string(rng.Below(static_cast<std::uint64_t>(c.max_keys))));
      share.offered += i == drive;
    }
  };
  pair.Run(60);
  share.sent = pair.offboard.link->sent(drive).sent;
  share.obeyed = pair.onboard.link->delivered(drive).delivered;
  return share;
}

TEST(CommandFreshness, OnABusyLineOfATenthOfASecondCommandsAreObeyed) {
  for (const auto& [up_s, down_s] : {std::pair{0.005, 0.005}, {0.05, 0.05}, {0.1, 0.0}, {0.0, 0.1}}) {
    const Share dut = DriveOnABusyLink(up_s, down_s, 1);
    const auto share = static_cast<double>(dut.obeyed) / static_cast<double>(dut.sent);
    RecordProperty(fmt::format("up_{}_down_{}_ms", 1000 * up_s, 1000 * down_s),
                   fmt::format("{} offered, {} sent, {} obeyed", dut.offered, dut.sent, dut.obeyed));
    EXPECT_GT(dut.offered, 1190U);
    EXPECT_GE(share, 0.99) << up_s << " " << down_s;
  }
}

}  // namespace
}  // namespace priamos::radio
