// A disk that is full takes the memory of a radio, not the link: with real processes, on a disk of their own.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "bus/log/log_reader.hpp"
#include "bus/node.hpp"
#include "lcmtypes/channels.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

/// The radio's HEALTH, as texts in their order, and the alarms.
struct Heard {
  std::vector<std::string> health, alarms;
  int stops = 0;
};

void ReadInto(Heard& heard, const std::string& path) {
  bus::LogReader log(path);
  while (const auto event = log.Next()) {
    if (event->channel == channels::kEstop.name) ++heard.stops;
    if (event->channel == channels::kAlarm.name)
      heard.alarms.push_back(bus::Decode<alarm_t>(event->bytes).text);
    if (event->channel != channels::kHealth.name) continue;
    const auto health = bus::Decode<health_t>(event->bytes);
    if (health.process == "offboard-radio" && health.state != health_t::STARTING)
      heard.health.push_back(health.text);
  }
}

TEST(FullDisk, StopsCrossWhileTheRadioCannotKeepItsMemory) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork(fmt::format(R"sh(
    cd {}
    mkdir memory; mount -t tmpfs -o size=64k tmpfs memory
    printf 'link = "%s"\n' $SOURCE/config/sim/link.toml > radio.toml
    $BIN/priamos link emulate --a tty-a --b tty-b > emulate.txt & EMULATE=$!
    until [ -e tty-b ]; do sleep 0.05; done
    radio() {{ exec $BIN/priamos-radio --config radio.toml --set side=$1 --set port=$2 --bus $1 "${{@:3}}" >> $1.txt 2>&1; }}
    offboard() {{ radio offboard tty-b --set state_file=memory/state & OFFBOARD=$!; sleep 1.5; }}
    stop() {{ $BIN/priamos topic pub ESTOP estop_t '{{"utime":1,"action":1,"driver":2}}' --bus offboard > pub.txt 2>&1; }}
    radio onboard tty-a & ONBOARD=$!
    offboard
    $BIN/priamos log record onboard.lcmlog --bus onboard > record.txt 2>&1 & RECORDERS=$!
    $BIN/priamos log record offboard.lcmlog --bus offboard > record2.txt 2>&1 & RECORDERS="$RECORDERS $!"
    sleep 1
    head -c 100000 /dev/zero > memory/fill
    stop; stop; sleep 1.2
    kill -9 $OFFBOARD; wait $OFFBOARD; offboard
    stop; stop; sleep 1.2
    rm memory/fill; sleep 2.3
    stop; sleep 0.5
    kill -INT $RECORDERS; wait $RECORDERS
    kill $ONBOARD $OFFBOARD $EMULATE; wait
  )sh",
                                                      folder.path().string()),
                                          folder / "script.sh", 60, "unshare -rnm");
  Heard heard;
  ReadInto(heard, folder / "offboard.lcmlog");
  const std::string why =
      "cannot keep its memory: " + (folder / "memory/state").string() + ": No space left on device";
  EXPECT_THAT(heard.health, testing::Contains(testing::StartsWith(why.substr(0, 90)))) << answer.text;
  ASSERT_FALSE(heard.health.empty());
  EXPECT_EQ(heard.health.back(), "");
  EXPECT_EQ(heard.alarms.size(), 2U) << "one of each process";
  for (const std::string& alarm : heard.alarms) EXPECT_THAT(alarm, testing::HasSubstr("No space left"));
  heard.stops = 0;
  ReadInto(heard, folder / "onboard.lcmlog");
  EXPECT_EQ(heard.stops, 5) << answer.text;
}

}  // namespace
}  // namespace priamos
