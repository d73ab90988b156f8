// Drive commands over a modem that begins to hold frames, and over IP while strangers flood the port, with
// the real programs in a network of their own.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/node.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

constexpr double kTimeToLive_s = 0.25;
constexpr double kHeld_s = 0.8;
/// The recorders are two processes of a busy machine; what is looked for is late by kHeld_s.
constexpr double kRecorders_s = 0.15;

/// An operator's commands, every 50 ms.
void WriteCommands(const std::string& path, int count) {
  bus::LogWriter log(path);
  for (int i = 1; i <= count; ++i) {
    drive_command_t command{};
    command.utime = 50'000 * i;
    command.sequence = i;
    command.time_to_live_s = kTimeToLive_s;
    log.Write(command.utime, channels::kDriveCommand.name, bus::Encode(command));
  }
}

/// When each command was on the bus, by its number [s].
std::map<int, double> TimesOf(const std::string& path) {
  std::map<int, double> times_s;
  bus::LogReader log(path);
  while (const auto event = log.Next())
    if (event->channel == channels::kDriveCommand.name)
      times_s[bus::Decode<drive_command_t>(event->bytes).sequence] = 1e-6 * static_cast<double>(event->utime);
  return times_s;
}

TEST(HeldLine, NoCommandIsObeyedThatAModemHasHeldBack) {
  const TemporaryFolder folder;
  WriteCommands(folder / "commands.lcmlog", 260);
  const auto answer = RunInPrivateNetwork(fmt::format(R"sh(
    cd {}
    echo 'way,from_s,to_s,first_s,last_s
b_to_a,6,10,{},{}' > delays.csv
    $BIN/priamos link emulate --a tty-a --b tty-b --delays delays.csv > emulate.txt & EMULATE=$!
    until [ -e tty-b ]; do sleep 0.05; done
    radio() {{ exec $BIN/priamos-radio --config $SOURCE/config/sim/radio.toml --set side=$1 --set port=$2 --bus $1; }}
    radio onboard tty-a & ONBOARD=$!
    radio offboard tty-b & OFFBOARD=$!
    for side in onboard offboard; do
      $BIN/priamos log record $side.lcmlog --bus $side > $side.txt 2>&1 & RECORDERS="${{RECORDERS:-}} $!"
    done
    sleep 1
    $BIN/priamos log play commands.lcmlog --bus offboard > play.txt
    kill -INT $RECORDERS; wait $RECORDERS
    kill $ONBOARD $OFFBOARD $EMULATE; wait
  )sh",
                                                      folder.path().string(), kHeld_s, kHeld_s),
                                          folder / "script.sh", 50);
  const auto offered = TimesOf(folder / "offboard.lcmlog"), obeyed = TimesOf(folder / "onboard.lcmlog");
  ASSERT_GT(offered.size(), 250U) << answer.text;
  int soon = 0, held = 0, after = 0;
  for (const auto& [number, time_s] : obeyed) {
    ASSERT_TRUE(offered.contains(number));
    EXPECT_LE(time_s - offered.at(number), kTimeToLive_s + kRecorders_s) << number;
    (number < 70 ? soon : number > 200 ? after : held) += 1;
  }
  EXPECT_GT(soon, 30) << answer.text;
  EXPECT_GT(after, 30) << answer.text;
  EXPECT_LT(held, 90) << "80 of them were held back";
}

/// Before there were places for proven ends 0 to 55 % arrived; what is missing now is the machine's.
TEST(RadioFlood, CommandsArriveWhileStrangersFloodThePort) {
  const TemporaryFolder folder;
  const auto answer =
      RunInPrivateNetwork("$BIN/bench_flood --quick --seconds 4 --least 80\n", folder / "script.sh", 60);
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
}

}  // namespace
}  // namespace priamos
