// A recorded door run, played by LCM's own player into a live planner, console and `priamos topic`: the
// planner decides what it decided then, and the console shows it as if it were live.

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>

#include "bus/clocks/log_time.hpp"
#include "bus/log/log_reader.hpp"
#include "bus/log_follower.hpp"
#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

const std::string kRecorded = PRIAMOS_SOURCE_DIR "/logs/recorded/door-udp-offboard.lcmlog";

/// Messages of one type by their channel, in their order.
template <class T>
std::vector<T> MessagesOf(const std::string& log, const std::string& channel) {
  const bus::Schema schema = bus::OwnTypes();
  std::vector<T> messages;
  bus::LogReader reader(log);
  while (const auto event = reader.Next())
    if (event->channel == channel)
      if (const auto message = bus::DecodeChecked<T>(schema, event->bytes)) messages.push_back(*message);
  return messages;
}

int CountOf(const std::string& log, const std::string& channel) {
  bus::LogReader reader(log);
  int events = 0;
  while (const auto event = reader.Next()) events += event->channel == channel ? 1 : 0;
  return events;
}

/// What a live planner sent beside the recorded messages of one channel, both in `log`.
template <class T>
void ExpectSame(const std::string& log, const std::string& channel,
                const std::function<void(const T& then, const T& now)>& compare) {
  const auto then = MessagesOf<T>(log, channel);
  const auto now = MessagesOf<T>(log, std::string(bus::LogFollower::kPrefix) + channel);
  ASSERT_EQ(now.size(), then.size()) << channel;
  for (std::size_t i = 0; i < then.size(); ++i) compare(then[i], now[i]);
}

/// How long after the newest stamp a message came at most, when `log` was recorded [us]: so far the time of
/// one who knows only stamps is behind that of the recorder. It is what the radio takes.
std::int64_t LongestDelay(const std::string& log) {
  const bus::Schema schema = bus::OwnTypes();
  std::optional<Time> newest;
  std::int64_t longest = 0;
  for (bus::LogReader reader(log); const auto event = reader.Next();)
    if (const auto stamp = bus::StampOf(schema, event->bytes)) {
      newest = std::max(*stamp, newest.value_or(*stamp));
      longest = std::max(longest, event->utime - ToUtime(*newest));
    }
  return longest;
}

constexpr std::int64_t kTick_us = 50'000;  ///< of the planner

/// An answer comes at most that delay and a tick earlier than it was recorded, and at most a tick later.
template <class T>
void ExpectInTime(const T& then, const T& now) {
  static const std::int64_t delay = LongestDelay(kRecorded);
  EXPECT_LE(then.utime - now.utime, delay + kTick_us);
  EXPECT_LE(now.utime - then.utime, kTick_us);
}

TEST(FollowsLogs, ARecordingTellsByHowMuchItsMessagesWereLate) {
  EXPECT_GT(LongestDelay(kRecorded), 50'000) << "what came over the radio";
  EXPECT_LT(LongestDelay(kRecorded), 500'000) << "or the bound of ExpectInTime says nothing";
}

/// The planner decided in `log` what it decided when it was recorded.
void ExpectSameDecisions(const std::string& log) {
  ASSERT_GT(CountOf(log, "PATH"), 0);
  ExpectSame<path_t>(log, "PATH", [](const path_t& then, const path_t& now) {
    ExpectInTime(then, now);
    ASSERT_EQ(now.points.size(), then.points.size());
    for (std::size_t i = 0; i < then.points.size(); ++i) {
      EXPECT_NEAR(now.points[i].x_m, then.points[i].x_m, 0.02);
      EXPECT_NEAR(now.points[i].y_m, then.points[i].y_m, 0.02);
    }
  });
  ExpectSame<look_request_t>(log, "LOOK_REQUEST", [](const look_request_t& then, const look_request_t& now) {
    ExpectInTime(then, now);
    EXPECT_EQ(now.landmark_id, then.landmark_id);
    EXPECT_EQ(now.side, then.side);
  });
  ExpectSame<landmark_model_t>(log, "LANDMARK_MODEL",
                               [](const landmark_model_t& then, const landmark_model_t& now) {
                                 EXPECT_EQ(now.landmark_id, then.landmark_id);
                               });
}

class FollowedLog : public testing::TestWithParam<int> {
 protected:
  FollowedLog() {
    answer_ =
        RunInPrivateNetwork("DIR=" + folder_.path().string() + "\nSPEED=" + std::to_string(GetParam()) + R"sh(
      export PRIAMOS_BUS=offboard PRIAMOS_ROBOT=replay
      $BIN/priamos log record $DIR/again.lcmlog --no-health > /dev/null & RECORDER=$!
      $BIN/priamos-planner --config $SOURCE/config/sim/planner.toml --clock bus & PLANNER=$!
      $BIN/priamos-console --config $SOURCE/config/sim/console.toml --clock bus --set port=0 2> $DIR/console.txt & CONSOLE=$!
      $BIN/priamos topic echo POSE x_m > $DIR/poses.txt & ECHO=$!
      until [ $(grep -cE ' 44..FFEF:' /proc/net/udp) -ge 4 ] && grep -q http $DIR/console.txt; do sleep 0.05; done
      PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$SOURCE/test/support python3 - $(grep -o '127.0.0.1:[0-9]*' $DIR/console.txt) > $DIR/page.txt <<'PY' & PAGE=$!
import sys
from station_page import Page, wait_for
page = Page(int(sys.argv[1].split(":")[1]))
page.say({"type": "stop"})
page.say({"type": "mission", "order": "abort"})
print("passed:", wait_for(lambda: "through the door" in str(page.messages.get("MISSION_STATUS")), 40))
wait_for(lambda: page.station["replay"]["paused"], 20)  # the log is over
print("ages:", [page.ages.get(channel, 99) < 3 for channel in ("POSE", "DRIVE_STATUS", "MISSION_STATUS")])
print("role:", page.station["role"], "log:", 15 < page.station["replay"]["position_s"] < 60, page.station["replay"]["paused"])
PY
      lcm-logplayer -l "$($BIN/priamos topic url)" -s $SPEED $SOURCE/logs/recorded/door-udp-offboard.lcmlog > /dev/null
      sleep 0.5; kill $PLANNER $RECORDER $ECHO; wait $PLANNER; echo "planner $?"; wait $RECORDER $PAGE; cat $DIR/page.txt
      kill $CONSOLE; wait $CONSOLE; echo "console $?, $(wc -l < $DIR/poses.txt) poses"
    )sh",
                            folder_ / "script.sh", 60);
  }
  const TemporaryFolder folder_;
  ShellAnswer answer_;
};

TEST_P(FollowedLog, ThePlannerDecidesAsItDidThenAndTheConsoleShowsIt) {
  SCOPED_TRACE(answer_.text);
  ExpectSameDecisions(folder_ / "again.lcmlog");
  EXPECT_THAT(answer_.text, HasSubstr("planner 0"));
  // The console shows it by the log's time, and commands nothing, whatever its page says.
  EXPECT_THAT(answer_.text,
              HasSubstr("passed: True\nages: [True, True, True]\nrole: viewer log: True True\n"));
  EXPECT_THAT(answer_.text, testing::ContainsRegex("console 0, [0-9]{2,} poses"))
      << "topic echo hears the log, too";
  for (const std::string channel :
       {"ESTOP", "MISSION_COMMAND", "DRIVE_COMMAND", "LEASE_REQUEST", "LINK_REQUEST"})
    EXPECT_EQ(CountOf(folder_ / "again.lcmlog", channel), CountOf(kRecorded, channel)) << channel;
}

INSTANTIATE_TEST_SUITE_P(AtSpeed, FollowedLog, testing::Values(4, 8));

/// Each speed with a robot's name, a bus and a beginning of the log of its own, so that all end after ten
/// seconds.
TEST(FollowsLogs, ThePlannerDecidesTheSameAtLowSpeeds) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork("DIR=" + folder.path().string() + R"sh(
    export PRIAMOS_BUS=offboard
    LOG=$SOURCE/logs/recorded/door-udp-offboard.lcmlog
    follow() {  # NAME SECONDS_OF_LOG PLAYER...
      export PRIAMOS_ROBOT=$1
      $BIN/priamos log filter $LOG $DIR/$1-part.lcmlog --to $2 > /dev/null
      $BIN/priamos log record $DIR/$1.lcmlog --no-health > /dev/null & RECORDER=$!
      $BIN/priamos-planner --config $SOURCE/config/sim/planner.toml --clock bus & PLANNER=$!
      PORT=$(printf %04X $($BIN/priamos topic url | sed 's/.*:\([0-9]*\).*/\1/'))
      until [ $(grep -c ":$PORT " /proc/net/udp) -ge 2 ]; do sleep 0.05; done
      "${@:3}" $DIR/$1-part.lcmlog > /dev/null
      sleep 0.5; kill $PLANNER $RECORDER; wait $PLANNER; echo "$1 $?"; wait $RECORDER
    }
    lcms() { lcm-logplayer -l "$($BIN/priamos topic url)" -s "$@"; }
    ours() { $BIN/priamos log play --speed "$@"; }
    thrice() { for play in 1 2 3; do lcms "$@"; sleep 0.2; done; }
    follow quarter 2.6 lcms 0.25 & follow half 4.6 ours 0.5 & follow once 8.5 lcms 1 & follow twice 17 ours 2 &
    follow thrice 8.5 thrice 4 & follow short 2.6 thrice 4 &
    wait
  )sh",
                                          folder / "script.sh", 60);
  for (const std::string speed : {"quarter", "half", "once", "twice", "thrice", "short"}) {
    SCOPED_TRACE(speed + "\n" + answer.text);
    EXPECT_THAT(answer.text, HasSubstr(speed + " 0"));
    ExpectSameDecisions(folder / (speed + ".lcmlog"));
  }
  // Played again, it is decided again: what a follower heard of the new play before it noticed is not lost.
  for (const std::string played : {"thrice", "short"})
    EXPECT_EQ(CountOf(folder / (played + ".lcmlog"), "REPLAYED_PATH"),
              3 * CountOf(folder / (played + "-part.lcmlog"), "PATH"))
        << played;
}

/// A recorder's HEALTH is stamped with the time it is sent, which is no time of the log: it was taken for
/// that, and nothing was decided.
TEST(FollowsLogs, ALiveRecorderBesideTheLogDisturbsNobody) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork("DIR=" + folder.path().string() + R"sh(
    export PRIAMOS_BUS=offboard PRIAMOS_ROBOT=replay
    LOG=$SOURCE/logs/recorded/door-udp-offboard.lcmlog
    $BIN/priamos log filter $LOG $DIR/part.lcmlog --to 8.5 > /dev/null
    $BIN/priamos log record $DIR/again.lcmlog > /dev/null & RECORDER=$!
    $BIN/priamos-planner --config $SOURCE/config/sim/planner.toml --clock bus 2> $DIR/planner.txt & PLANNER=$!
    until grep -q 'HEALTH of recorder' $DIR/planner.txt; do sleep 0.05; done
    $BIN/priamos log play --speed 1 $DIR/part.lcmlog > /dev/null
    sleep 3.5; kill $PLANNER $RECORDER; wait $PLANNER; echo "planner $?"; wait $RECORDER; cat $DIR/planner.txt
  )sh",
                                          folder / "script.sh", 60);
  SCOPED_TRACE(answer.text);
  ExpectSameDecisions(folder / "again.lcmlog");
  EXPECT_THAT(answer.text, HasSubstr("planner 0"));
  EXPECT_THAT(answer.text,
              testing::ContainsRegex("HEALTH of recorder at .* is stamped with the present time"));
  EXPECT_THAT(answer.text, testing::Not(HasSubstr("no pose"))) << "its time stood still with the log";
}

/// Only what commands nobody may follow a log.
TEST(FollowsLogs, ARobotDoesNot) {
  const auto answer = RunShell("'" PRIAMOS_BINARY_DIR "/bin/priamos-robot' --clock bus");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_NE(answer.text.find("--clock"), std::string::npos) << answer.text;
}

}  // namespace
}  // namespace priamos
