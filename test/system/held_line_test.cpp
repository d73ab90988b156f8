// Drive commands over a modem that begins to hold frames, and over IP while strangers flood the port, with
// the real programs in a network of their own.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "bus/log/log_reader.hpp"
#include "bus/node.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

constexpr double kTimeToLive_s = 0.25;  ///< of the commands of drive_commands.py
constexpr double kHeld_s = 0.8;
/// The recorders are two processes of a busy machine; what is looked for is late by kHeld_s.
constexpr double kRecorders_s = 0.15;

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
    python3 $SOURCE/test/support/drive_commands.py 260
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

/// The first 20 are put on the bus half a second after they were made, the next 20 at once.
TEST(HeldLine, NoCommandIsSentThatItsBusHasHeldBack) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork(fmt::format(R"sh(
    cd {}
    $BIN/priamos link emulate --a tty-a --b tty-b > emulate.txt & EMULATE=$!
    until [ -e tty-b ]; do sleep 0.05; done
    radio() {{ exec $BIN/priamos-radio --config $SOURCE/config/sim/radio.toml --set side=$1 --set port=$2 --bus $1 >> $1.txt 2>&1; }}
    radio onboard tty-a & ONBOARD=$!
    radio offboard tty-b & OFFBOARD=$!
    $BIN/priamos log record held.lcmlog --bus onboard > held.txt 2>&1 & RECORDER=$!
    sleep 1
    python3 $SOURCE/test/support/drive_commands.py 20 --kept 0.5
    sleep 0.5; kill -INT $RECORDER; wait $RECORDER
    $BIN/priamos log record fresh.lcmlog --bus onboard > fresh.txt 2>&1 & RECORDER=$!
    sleep 0.5
    python3 $SOURCE/test/support/drive_commands.py 20
    sleep 0.5; kill -INT $RECORDER; wait $RECORDER
    kill $ONBOARD $OFFBOARD $EMULATE; wait; cat offboard.txt
  )sh",
                                                      folder.path().string()),
                                          folder / "script.sh", 50);
  EXPECT_EQ(TimesOf(folder / "held.lcmlog").size(), 0U) << answer.text;
  EXPECT_GT(TimesOf(folder / "fresh.lcmlog").size(), 14U) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("DRIVE_COMMAND: a command came later than 0.25 s after its own stamp"));
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
