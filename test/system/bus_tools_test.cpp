#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/log/type_texts.hpp"
#include "bus/node.hpp"
#include "lcmtypes/channels.hpp"
#include "private_network.hpp"
#include "test/support/temporary_folder.hpp"

// `priamos topic` and `priamos log`, and LCM's own tools, on a real UDP multicast bus.

namespace priamos {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What was on each channel, in order.
using Contents = std::map<std::string, std::vector<std::vector<std::byte>>>;

Contents ReadContents(const std::string& log) {
  bus::LogReader reader(log);
  Contents contents;
  while (auto event = reader.Next()) contents[event->channel].push_back(std::move(event->bytes));
  EXPECT_EQ(reader.skipped_bytes(), 0u) << log;
  contents.erase("READY");
  contents.erase(std::string(bus::kTypeText));  // what a recorder says itself
  return contents;
}

/// How a recording of a while agrees with one that began earlier and ended later.
struct Overlap {
  std::size_t in_both = 0, missing_in_all = 0, missing_in_part = 0;
  Overlap& operator+=(const Overlap& o) {
    in_both += o.in_both;
    missing_in_all += o.missing_in_all;
    missing_in_part += o.missing_in_part;
    return *this;
  }
};

Overlap Compare(const std::vector<std::vector<std::byte>>& all,
                const std::vector<std::vector<std::byte>>& part) {
  Overlap overlap;
  auto next = all.begin();
  for (const auto& message : part) {
    const auto at = std::find(next, all.end(), message);
    if (at == all.end()) {
      ++overlap.missing_in_all;
      continue;
    }
    if (overlap.in_both++ > 0) overlap.missing_in_part += static_cast<std::size_t>(at - next);
    next = at + 1;
  }
  return overlap;
}

class BusTools : public testing::Test {
 protected:
  /// Two seconds of 50 Hz poses and 10 Hz sonars.
  void WriteLog(const std::string& file) {
    bus::LogWriter writer(file);
    for (int i = 0; i < 100; ++i) {
      const std::int64_t utime = 1'000'000'000 + i * 20'000;
      pose_t pose{};
      pose.utime = utime;
      pose.x_m = 0.01 * i;
      writer.Write(utime, "POSE", bus::Encode(pose));
      sonar_ranges_t sonar{};
      sonar.utime = utime;
      if (i % 5 == 0) writer.Write(utime, "SONAR_RANGES", bus::Encode(sonar));
    }
  }
  ShellAnswer Run(const std::string& script, int seconds = 30, const std::string& unshare = "unshare -rn") {
    return RunInPrivateNetwork(
        "export PRIAMOS_BUS='udpm://239.255.76.67:7667?ttl=0'\ncd " + folder_.path().string() + "\n" + script,
        folder_ / "script.sh", seconds, unshare);
  }
  TemporaryFolder folder_;
  std::string log_ = folder_ / "in.lcmlog";
};

TEST_F(BusTools, PlayAndRecordKeepEveryByte) {
  WriteLog(log_);
  const auto answer = Run(R"sh(
    $BIN/priamos log record out.lcmlog --no-health & recorder=$!
    listening
    $BIN/priamos log play in.lcmlog --speed 4
    sleep 0.3; kill -INT $recorder; wait $recorder)sh");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("120 events sent, 0 refused"));
  EXPECT_THAT(answer.text, HasSubstr("lost: 0 on the network, 0 on the disk"));
  EXPECT_EQ(ReadContents(folder_ / "out.lcmlog"), ReadContents(log_));
}

/// `record FILE` starts LCM's recorder and returns when it hears, `stop` ends it. A socket that is open need
/// not have joined the group yet, hence READY.
const std::string kLogger = R"sh(
    URL=$PRIAMOS_BUS
    record() {
      lcm-logger --lcm-url="$URL" --flush-interval=50 -q $1 & logger=$!
      until [ -s $1 ]; do $BIN/priamos topic pub READY link_request_t '{"utime":0,"channel":"","hold_s":0}' > /dev/null; sleep 0.1; done
    }
    stop() { sleep 1; kill -INT $logger; wait $logger; }
)sh";

/// Six seconds of a recorded door run, all its channels. LCM counts no losses: on a machine so busy that some
/// happen, the whole is done again, at half the speed.
TEST_F(BusTools, LcmLoggerAndLcmLogplayerDoSoToo) {
  Contents in, theirs, again;
  std::string text;
  for (int attempt = 0; attempt < 3 && (in.empty() || theirs != in || again != in); ++attempt) {
    text = Run("SPEED=" + std::to_string(4 >> attempt) + kLogger + R"sh(
    rm -f *.lcmlog
    $BIN/priamos log filter $SOURCE/logs/recorded/door-onboard.lcmlog in.lcmlog --from 4 --to 10
    record theirs.lcmlog; $BIN/priamos log play in.lcmlog --speed $SPEED; stop
    record again.lcmlog; lcm-logplayer --lcm-url="$URL" --speed=$SPEED theirs.lcmlog; stop)sh",
               60)
               .text;
    in = ReadContents(log_);
    theirs = ReadContents(folder_ / "theirs.lcmlog");
    again = ReadContents(folder_ / "again.lcmlog");
  }
  EXPECT_GT(in.size(), 8u) << "channels";
  EXPECT_TRUE(theirs == in) << text;
  EXPECT_TRUE(again == in) << text;
}

/// The whole simulation for some seconds: LCM's recorder hears what ours hears, and its player gives it back.
TEST_F(BusTools, ALiveRobotIsRecordedByLcmLoggerAndPlayedByLcmLogplayer) {
  const auto answer = Run(kLogger + R"sh(
    export PRIAMOS_BUS=onboard; URL=$($BIN/priamos topic url)
    $BIN/priamos up $SOURCE/config/sim --logs logs > up.txt 2>&1 & up=$!
    for i in $(seq 150); do grep -q 'all processes are ready' up.txt && break; sleep 0.1; done; cat up.txt
    $BIN/priamos log record ours.lcmlog --no-health & recorder=$!
    until [ -s ours.lcmlog ]; do sleep 0.1; done
    record theirs.lcmlog; sleep 3; stop
    kill -INT $recorder; wait $recorder
    $BIN/priamos down --logs logs; wait $up
    record again.lcmlog; lcm-logplayer --lcm-url="$URL" --speed=1 theirs.lcmlog; stop)sh",
                          60);
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const Contents ours = ReadContents(folder_ / "ours.lcmlog"),
                 theirs = ReadContents(folder_ / "theirs.lcmlog");
  EXPECT_GT(theirs.size(), 8u) << "channels; " << answer.text;
  // UDP loses on a machine that is busy; ours counts what it lost, lcm-logger does not.
  Overlap sum;
  for (const auto& [channel, messages] : theirs) {
    ASSERT_EQ(ours.count(channel), 1u) << channel << "; " << answer.text;
    sum += Compare(ours.at(channel), messages);
  }
  EXPECT_GT(sum.in_both, 500u);
  EXPECT_LT(sum.missing_in_part, sum.in_both / 50) << answer.text;
  if (answer.text.find("lost: 0 on the network") != std::string::npos) {
    EXPECT_EQ(sum.missing_in_all, 0u) << answer.text;
  }
  sum = {};
  const Contents again = ReadContents(folder_ / "again.lcmlog");
  for (const auto& [channel, messages] : again) sum += Compare(theirs.at(channel), messages);
  EXPECT_EQ(again.size(), theirs.size());
  EXPECT_EQ(sum.missing_in_all, 0u) << answer.text;
  EXPECT_LT(sum.missing_in_part, sum.in_both / 50) << answer.text;
}

TEST_F(BusTools, TopicShowsTypesRatesAndLosses) {
  WriteLog(log_);
  const auto answer = Run(R"sh(
    $BIN/priamos log play in.lcmlog --loop & player=$!
    $BIN/priamos topic list --json --seconds 2; echo
    $BIN/priamos topic echo POSE --json --count 1
    kill -INT $player; wait $player)sh");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  const auto list = nlohmann::json::parse(answer.text.substr(0, answer.text.find('\n')));
  EXPECT_EQ(list["lost"], 0);
  ASSERT_EQ(list["senders"].size(), 1u);
  EXPECT_EQ(list["senders"][0]["lost"], 0);
  ASSERT_EQ(list["channels"].size(), 2u);
  EXPECT_EQ(list["channels"][0]["type"], "priamos.pose_t");
  EXPECT_NEAR(list["channels"][0]["rate_hz"].get<double>(), 50, 5);
  EXPECT_EQ(list["channels"][1]["undecodable"], 0);
  EXPECT_THAT(answer.text, HasSubstr("\"x_m\":0."));
}

TEST_F(BusTools, APortThatAnotherProgramHasForItselfIsNamed) {
  const auto answer = Run(R"sh(
    BUS='udpm://239.255.76.71:7791?ttl=0'
    python3 -c 'import socket, time; s = socket.socket(type=socket.SOCK_DGRAM); s.bind(("", 7791)); print(1, flush=True); time.sleep(30)' \
      > bound & HOLDER=$!
    for i in $(seq 100); do [ -s bound ] && break; sleep 0.05; done
    $BIN/priamos doctor --bus $BUS --probe; echo "doctor: $?"
    $BIN/priamos topic list --bus $BUS; echo "topic: $?"
    kill $HOLDER)sh");
  EXPECT_THAT(
      answer.text,
      HasSubstr(
          "BAD   bus                    bus udpm://239.255.76.71:7791?ttl=0: expected a port to share"));
  EXPECT_THAT(answer.text, HasSubstr("next: ss -ulpn sport = :7791 names it"));
  EXPECT_THAT(answer.text, HasSubstr("doctor: 1"));
  EXPECT_THAT(answer.text, HasSubstr("topic: 2"));
}

TEST_F(BusTools, ForeignTypesNeedNoCompilation) {
  const auto answer = Run(R"sh(
    mkdir types; echo 'package theirs; struct thing_t { int32_t n; string names[n]; }' > types/thing.lcm
    $BIN/priamos topic echo THING --types types --json --count 1 & listener=$!
    listening
    $BIN/priamos topic pub THING thing_t '{"names":["a","b"]}' --types types
    wait $listener
    $BIN/priamos type show theirs.thing_t --types types)sh");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr(R"({"n":2,"names":["a","b"]})"));
  EXPECT_THAT(answer.text, HasSubstr("of no bounded size"));
}

TEST_F(BusTools, LargeMessagesOfAForeignBusComeInFragments) {
  const auto answer = Run(R"sh(
    mkdir types; echo 'package theirs; struct text_t { string text; }' > types/text.lcm
    $BIN/priamos topic echo BIG --types types --fragments --count 2 > heard.txt 2> /dev/null & listener=$!
    listening
    for i in 1 2; do
      $BIN/priamos topic pub BIG text_t "{\"text\":\"$(head -c 100000 /dev/zero | tr '\0' x)\"}" --types types --fragments
    done
    wait $listener; wc -c < heard.txt)sh");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_GT(std::atoi(answer.text.c_str()), 200'000) << answer.text.substr(0, 300);
}

TEST_F(BusTools, FullDiskIsToldAndTheLogStaysWhole) {
  WriteLog(log_);
  const auto answer = Run(R"sh(
    mkdir disk; mount -t tmpfs -o size=16k none disk
    $BIN/priamos topic echo HEALTH --json > health.txt & listener=$!
    $BIN/priamos log record disk/run.lcmlog --keep-free-mb 0 > record.txt 2>&1 & recorder=$!
    until [ -e disk/run.lcmlog ]; do sleep 0.05; done; listening
    $BIN/priamos log play in.lcmlog --speed max
    for i in $(seq 1000); do grep -q ALARM record.txt && break; sleep 0.01; done
    cat record.txt
    sleep 0.2; kill -INT $recorder $listener; wait $recorder; echo "exit code $?"
    cp disk/run.lcmlog kept.lcmlog; cat health.txt)sh",
                          30, "unshare -rnm");
  EXPECT_THAT(answer.text, HasSubstr("ALARM: disk/run.lcmlog: recording stopped: No space left on device"));
  EXPECT_THAT(answer.text, HasSubstr("exit code 1"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("\"process\":\"recorder\",\"state\":3.*No space left"));
  std::size_t events = 0;
  for (const auto& [channel, messages] : ReadContents(folder_ / "kept.lcmlog")) events += messages.size();
  EXPECT_GT(events, 60u);  // 120 events of 150 to 250 bytes; 16 kB hold most of them
}

/// The recorder is a process of its own: what happens to it does not reach the robot.
TEST_F(BusTools, ARobotIsNotAffectedByAFullDisk) {
  WriteLog(log_);
  const auto answer = Run(R"sh(
    mkdir disk; mount -t tmpfs -o size=16k none disk
    $BIN/priamos topic echo HEALTH --json > health.txt & listener=$!
    $BIN/priamos-robot --config $SOURCE/config/sim/robot.toml 2> /dev/null & robot=$!
    $BIN/priamos log record disk/run.lcmlog --keep-free-mb 0 > record.txt 2>&1 & recorder=$!
    until grep -q ALARM record.txt; do $BIN/priamos log play in.lcmlog --speed max > /dev/null; sleep 0.1; done
    sleep 2.5; kill -INT $recorder $robot; wait $recorder; wait $robot; echo "robot: exit code $?"
    kill -INT $listener; wait $listener; cat health.txt)sh",
                          30, "unshare -rnm");
  EXPECT_THAT(answer.text, HasSubstr("robot: exit code 0"));
  int after_alarm = 0;
  bool alarm = false;
  std::istringstream lines(answer.text);
  for (std::string line; std::getline(lines, line);) {
    const auto health = nlohmann::json::parse(line, nullptr, false);
    if (!health.is_object()) continue;
    alarm |= health["process"] == "recorder" && health["state"] == health_t::FAILED;
    if (!alarm || health["process"] != "robot") continue;
    ++after_alarm;
    EXPECT_EQ(health["messages_lost"], 0) << line;
    EXPECT_EQ(health["handler_exceptions"], 0) << line;
  }
  EXPECT_GE(after_alarm, 2) << answer.text;
}

TEST_F(BusTools, ReadOnlyDiskIsASentenceAtTheStart) {
  const auto answer = Run(R"sh(
    mkdir disk; mount -t tmpfs -o ro none disk
    $BIN/priamos log record disk/run.lcmlog; echo "exit code $?")sh",
                          30, "unshare -rnm");
  EXPECT_THAT(answer.text, HasSubstr("disk/run.lcmlog: cannot be written: Read-only file system"));
  EXPECT_THAT(answer.text, HasSubstr("exit code 2"));
}

TEST_F(BusTools, OtherGroupsOnTheSamePortAreNotHeard) {
  WriteLog(log_);
  const auto answer = Run(R"sh(
    $BIN/priamos log play in.lcmlog --loop --bus 'udpm://239.255.76.99:7667?ttl=0' & player=$!
    $BIN/priamos topic list --seconds 1
    kill -INT $player; wait $player)sh");
  EXPECT_THAT(answer.text, HasSubstr("nothing is heard on "));
}

TEST_F(BusTools, WhoWaitsInVainIsToldWhy) {
  WriteLog(log_);
  const auto answer = Run(R"sh(
    unset PRIAMOS_BUS
    $BIN/priamos log play in.lcmlog --loop --bus onboard & player=$!
    sleep 0.5
    timeout -s INT 4 $BIN/priamos topic echo POZE --bus onboard > poze.out 2> poze.err
    timeout -s INT 4 $BIN/priamos topic echo POSE > other.out 2> other.err
    timeout -s INT 20 $BIN/priamos where 2> where.err > where.out; echo "where: $?"
    timeout -s INT 20 $BIN/priamos mission status 2> mission.err; echo "mission: $?"
    timeout -s INT 20 $BIN/priamos topic echo POSE x_m utime --count 2 --bus onboard --json 2> good.err
    kill -INT $player; wait $player
    cat poze.err other.err where.err mission.err good.err; wc -c < poze.out)sh");
  EXPECT_THAT(answer.text, HasSubstr("topic echo: nobody publishes POZE on onboard (udpm://239.255.234.67:"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("nearest: \"POSE\" \\([0-9.]+ Hz\\)"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("nobody publishes POSE on offboard .*; it is on onboard "
                                                  "\\([0-9.]+ Hz\\): --bus onboard"));
  EXPECT_THAT(answer.text, HasSubstr("priamos where: nobody publishes POSE on offboard"));
  EXPECT_THAT(answer.text, HasSubstr("priamos mission status: nothing is heard on offboard"));
  EXPECT_THAT(answer.text, HasSubstr("where: 1\nmission: 1\n"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("\\{\"x_m\":[0-9.]+,\"utime\":[0-9]+\\}"));
}

/// What killed every subscriber of LCM 1.3.1, and other things that LCM does not send.
TEST_F(BusTools, FragmentsAndNonsenseHarmNobody) {
  WriteLog(log_);
  const auto answer = Run(R"sh(
    $BIN/priamos log record out.lcmlog --no-health > record.txt & recorder=$!
    listening
    python3 - <<'END'
import random, socket, struct
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
bus = ("239.255.76.67", 7667)
random.seed(1)
# LC03: magic, number, message size, fragment offset, fragment number, fragments
for offset in (0, 2**32 - 8, 2**32 - 1, 2**31):
    for number in (0, 1):
        s.sendto(struct.pack(">4sIIIHH", b"LC03", 7, 100, offset, number, 2) + b"POSE\0" + b"x" * 40, bus)
for i in range(3000):
    magic = random.choice([b"LC02", b"LC03", b"LC01", b"\0\0\0\0"])
    s.sendto(magic + random.randbytes(random.randrange(0, 300)), bus)
END
    $BIN/priamos log play in.lcmlog --speed 4 --rename POSE=POSE_AFTER
    sleep 0.3; kill -INT $recorder; wait $recorder; echo "exit code $?")sh");
  EXPECT_THAT(answer.text, HasSubstr("exit code 0"));
  auto contents = ReadContents(folder_ / "out.lcmlog");
  EXPECT_EQ(contents["POSE_AFTER"].size(), 100u) << answer.text;
  EXPECT_EQ(contents["POSE"].size(), 0u);
}

/// PRIAMOS_MUTATIONS=1000000 makes it a long run.
TEST_F(BusTools, EveryDatagramIsCountedWhateverIsInIt) {
  WriteLog(log_);
  const char* wanted = std::getenv("PRIAMOS_MUTATIONS");
  const int n = wanted ? std::atoi(wanted) : 20'000;
  const auto answer = Run("N=" + std::to_string(n) + R"sh(
    $BIN/priamos topic list --json --seconds $((3 + N / 20000)) & listener=$!
    listening
    python3 - in.lcmlog $N <<'END'
import random, socket, struct, sys
log, messages, at = open(sys.argv[1], "rb").read(), [], 0
while at < len(log):
    channel, data = struct.unpack(">II", log[at + 20:at + 28])
    at += 28
    messages.append((log[at:at + channel], log[at + channel:at + channel + data]))
    at += channel + data
s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
random.seed(1)
extremes = [b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\x80\0\0\0", b"\0\0\0\0", b"\xff\xff\xff\xf8"]
for i in range(int(sys.argv[2])):
    channel, data = random.choice(messages)
    number = struct.pack(">I", random.choice([i, 2**32 - 1 - i, random.getrandbits(32)]))
    d = bytearray(b"LC02" + number + channel + b"\0" + data)
    kind = random.randrange(5)
    if kind == 0:  # an extreme number anywhere
        where = random.randrange(len(d))
        d[where:where + 4] = random.choice(extremes)
    elif kind == 1:
        d = d[:random.randrange(len(d))]
    elif kind == 2:  # a fragment
        d = struct.pack(">4s4sIIHH", b"LC03", number, random.getrandbits(32),
                        random.choice([0, 2**32 - 8, 2**32 - 1, random.getrandbits(32)]),
                        random.choice([0, 1, 65535]), random.choice([0, 2, 65535])) + bytes(d[8:])
    elif kind == 3:
        d = b"LC02" + random.randbytes(random.randrange(1500))
    else:
        d = random.randbytes(random.randrange(1500))
    s.sendto(d, ("239.255.76.67", 7667))
END
    wait $listener)sh",
                          60 + n / 10'000);
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const auto list = nlohmann::json::parse(answer.text);
  int heard = 0, undecodable = 0;
  for (const auto& channel : list["channels"]) {
    heard += channel["messages"].get<int>();
    undecodable += channel["undecodable"].get<int>();
  }
  const int malformed = list["malformed"], turned_away = list["turned_away"];
  EXPECT_EQ(heard + malformed + turned_away, n);
  EXPECT_GT(undecodable, n / 50);
  EXPECT_GT(malformed, n / 50);
  EXPECT_GT(turned_away, n / 3);
  std::cout << heard << " heard, " << undecodable << " of them undecodable, " << malformed << " malformed, "
            << turned_away << " turned away\n";
}

/// Each of these would otherwise go on for ever.
TEST_F(BusTools, ALiveVerbEndsWhenNothingCanBeWrittenAnyMore) {
  const auto answer = Run(R"(
    $BIN/priamos log play $SOURCE/logs/recorded/door-onboard.lcmlog --loop --bus onboard > /dev/null & player=$!
    for verb in 'topic echo POSE' 'topic list --watch' 'link top' 'where --watch'; do
      timeout 8 $BIN/priamos $verb --bus onboard > /dev/full; echo "$verb: full $?"
      timeout 8 $BIN/priamos $verb --bus onboard >&-; echo "$verb: closed $?"
      timeout 8 $BIN/priamos $verb --bus onboard | head -1 > /dev/null; echo "$verb: pipe ${PIPESTATUS[0]}"
    done
    kill $player; wait $player)",
                          60);
  for (const std::string verb : {"topic echo POSE", "topic list --watch", "link top", "where --watch"})
    for (const char* end : {": full 2\n", ": closed 2\n", ": pipe 141\n"})
      EXPECT_THAT(answer.text, HasSubstr(verb + end));
}

TEST_F(BusTools, DoctorNamesTheCommandThatMends) {
  const auto answer = Run("ip route del 224.0.0.0/4; $BIN/priamos doctor; echo \"exit code $?\"");
  EXPECT_THAT(answer.text, HasSubstr("BAD   multicast route"));
  EXPECT_THAT(answer.text,
              HasSubstr("sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo"));
  EXPECT_THAT(answer.text, HasSubstr("exit code 1"));
}

}  // namespace
}  // namespace priamos
