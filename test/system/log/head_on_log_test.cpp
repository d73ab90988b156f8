// A door run that kept the pictures its head used: from these and the log the head sees again what it saw,
// run from the file and on the log as LCM's own player plays it onto a bus.

#include <gmock/gmock.h>

#include <filesystem>
#include <regex>

#include "bus/log/log_reader.hpp"
#include "bus/log_follower.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

std::vector<std::vector<std::byte>> MessagesOn(const std::string& log, const std::string& channel) {
  std::vector<std::vector<std::byte>> messages;
  bus::LogReader reader(log);
  while (const auto event = reader.Next())
    if (event->channel == channel) messages.push_back(event->bytes);
  return messages;
}

/// What the head saw, in its order. Its commands to its motors are not among it: the log does not tell on
/// which side of a silent tick a look was asked for, so on a bus they may come one tick earlier.
std::vector<std::pair<std::string, std::vector<std::byte>>> Seen(const std::string& log,
                                                                 const std::string& prefix) {
  std::vector<std::pair<std::string, std::vector<std::byte>>> seen;
  bus::LogReader reader(log);
  while (const auto event = reader.Next())
    for (const std::string channel : {"LANDMARK_FIX", "LANDMARK_VIEW", "DOOR_SEEN", "OBSTACLE_LINE"})
      if (event->channel == prefix + channel) seen.emplace_back(channel, event->bytes);
  return seen;
}

/// Whether `verify` lists several messages of the channel, all of them equal.
bool IsEqualThroughout(const std::string& channel, const std::string& text) {
  return std::regex_search(text, std::regex(channel + R"( +([1-9][0-9]*) +\1 +\1\n)"));
}

TEST(HeadOnALog, SeesInKeptPicturesWhatItSawThen) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork("DIR=" + folder.path().string() + R"sh(
    export PRIAMOS_BUS=onboard PRIAMOS_ROBOT=replay
    $BIN/priamos lockstep --scenario door --seed 1 --logs "$DIR/a run" --pictures > /dev/null
    RUN="$DIR/a run/seed-1"
    verify() { $BIN/priamos replay verify "$RUN/onboard.lcmlog" --module head "$@"; echo "verify $?"; }
    verify --pictures "$RUN/pictures"
    $BIN/priamos log filter "$RUN/onboard.lcmlog" $DIR/part.lcmlog --to 12 --without WORLD_TRUTH > /dev/null
    $BIN/priamos log record $DIR/again.lcmlog --no-health > /dev/null & RECORDER=$!
    $BIN/priamos-head --config $SOURCE/config/sim/head.toml --clock bus --pictures "$RUN/pictures" 2> $DIR/head.txt & HEAD=$!
    until [ $(grep -cE ' 43..FFEF:' /proc/net/udp) -ge 2 ]; do sleep 0.05; done
    lcm-logplayer -l "$($BIN/priamos topic url)" -s 4 $DIR/part.lcmlog > /dev/null
    sleep 0.5; kill $HEAD $RECORDER; wait $HEAD; echo "head $?"; wait $RECORDER; cat $DIR/head.txt
    rm "$(ls "$RUN"/pictures/*-left.pgm | sed -n 5p)"  # of a look: glances come later
    echo "--- one lost"; verify --pictures "$RUN/pictures"
  )sh",
                                          folder / "script.sh", 90);
  for (const std::string channel : {"LANDMARK_FIX", "LANDMARK_VIEW"})
    EXPECT_TRUE(IsEqualThroughout(channel, answer.text)) << "from the file" << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("head 0"));
  for (const std::string channel : {"LANDMARK_FIX", "LANDMARK_VIEW", "DOOR_SEEN"}) {
    const auto then = MessagesOn(folder / "again.lcmlog", channel);
    EXPECT_GT(then.size(), 1U) << channel << answer.text;
    EXPECT_EQ(MessagesOn(folder / "again.lcmlog", std::string(bus::LogFollower::kPrefix) + channel), then)
        << channel << answer.text;
  }
  EXPECT_THAT(answer.text.substr(0, answer.text.find("--- one lost")),
              HasSubstr("every byte is as it was recorded"))
      << "from the file: HEAD_COMMAND, too";
  const std::string again = folder / "again.lcmlog";
  EXPECT_EQ(Seen(again, std::string(bus::LogFollower::kPrefix)), Seen(again, ""));
  EXPECT_THAT(answer.text.substr(answer.text.find("--- one lost")),
              testing::ContainsRegex("LANDMARK_FIX [0-9]+ at [^\n]*verdict: recorded [0-9], replayed 3\n"))
      << "its look alone ends without pictures";
}

}  // namespace
}  // namespace priamos
