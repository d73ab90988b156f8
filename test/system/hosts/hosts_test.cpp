// Several computers on one switch, each in a network namespace of its own: interface and ttl of a bus, the
// probe from host to host, a deployment over hosts, two robots in one network, the clock of a host.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Hosts : public testing::Test {
 protected:
  ShellAnswer Run(const std::string& script, int seconds = 60) const {
    return RunInPrivateNetwork("DIR=" + folder_.path().string() + "\nSIM=$SOURCE/config/sim\n" + script,
                               folder_ / "script.sh", seconds, "unshare -rnu");
  }
  ShellAnswer RunOnHosts(const std::string& script, int seconds = 60) const {
    return Run("source $SOURCE/test/support/computers.sh\n" + script, seconds);
  }

  const TemporaryFolder folder_;
};

/// The text between "--- name" and the next "---".
std::string Part(const ShellAnswer& answer, const std::string& name) {
  const std::string head = "--- " + name + "\n";
  const auto begin = answer.text.find(head);
  if (begin == std::string::npos) return "no part " + name + " in:\n" + answer.text;
  const auto from = begin + head.size();
  return answer.text.substr(from, answer.text.find("--- ", from) - from);
}

/// eth9 leads to the other computer, the route for multicast to eth0.
constexpr const char* kWrongRoute = R"sh(
host base 10.77.0.1; host vision 10.77.0.2
on base bash -c 'ip link add eth0 type veth peer name far && ip addr add 10.88.0.1/24 dev eth0 &&
  ip link set eth0 up && ip link set far up && ip route add 224.0.0.0/4 dev eth0'
)sh";

TEST_F(Hosts, WhereABusNamesItsNetworkTheRouteDoesNotMatter) {
  const auto answer = RunOnHosts(std::string(kWrongRoute) + R"sh(
    say() { on base $BIN/priamos topic pub LINK_REQUEST link_request_t "{\"utime\":0,\"channel\":\"POSE\",\"hold_s\":$1}" \
              --bus onboard "${@:2}" > /dev/null; }
    start vision timeout 50 $BIN/priamos topic echo LINK_REQUEST hold_s --bus onboard --network 10.77.0.2 --count 3 \
      > $DIR/heard 2> /dev/null
    until grep -q ' 43..FFEF:' /proc/$STARTED/net/udp; do sleep 0.05; done; sleep 0.3
    say 1 --ttl 1
    say 2 --network eth9
    say 3 --ttl 1 --network eth9
    say 4 --ttl 1 --network 10.77.0.1
    PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9 say 5
    wait $STARTED
    echo "--- heard"; cat $DIR/heard
    echo "--- wrong"; say 6 --network eth7 2>&1 | head -1
  )sh");
  EXPECT_EQ(Part(answer, "heard"), "3.0\n4.0\n5.0\n")
      << "not by the route, and not with ttl 0; " << answer.text;
  EXPECT_THAT(Part(answer, "wrong"), AllOf(HasSubstr("expected an interface of this host or its address"),
                                           HasSubstr("eth9 (10.77.0.1)"), HasSubstr("got \"eth7\"")));
}

TEST_F(Hosts, TheDoctorSaysByWhichWayABusLeavesAndWhatIsInTheWay) {
  const auto answer = RunOnHosts(std::string(kWrongRoute) + R"sh(
    look() { echo "--- $1"; on base $BIN/priamos doctor --bus onboard "${@:2}" | grep -A1 'other hosts'; }
    look route --ttl 1
    look named --ttl 1 --network eth9
    look stays
    mkdir $DIR/two; cat > $DIR/two/deployment.toml << 'END'
onboard_network = "eth9"
[[process]]
module = "robot"
bus = "onboard"
config = "robot.toml"
host = "base"
[[process]]
module = "head"
bus = "onboard"
config = "head.toml"
host = "vision"
END
    look deployment --deployment $DIR/two/
  )sh");
  EXPECT_THAT(Part(answer, "route"),
              ContainsRegex("note +other hosts +messages leave by eth0, because the route.*"
                            "also here: .*eth9 \\(10.77.0.1\\)"));
  EXPECT_THAT(Part(answer, "route"), HasSubstr("export PRIAMOS_NETWORK="));
  EXPECT_THAT(Part(answer, "named"), ContainsRegex("good +other hosts +messages leave by eth9, ttl 1"));
  EXPECT_THAT(Part(answer, "stays"), ContainsRegex("note +other hosts +with ttl 0"));
  EXPECT_THAT(Part(answer, "deployment"), ContainsRegex("BAD +other hosts +with ttl 0"))
      << "two hosts are named";
}

TEST_F(Hosts, AProbeNamesTheWayThatIsCut) {
  const auto answer = RunOnHosts(R"sh(
    host base 10.77.0.1; host vision 10.77.0.2
    export PRIAMOS_BUS=onboard PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9
    start vision $BIN/priamos-robot --config $SIM/robot.toml 2> /dev/null; ROBOT=$STARTED
    on base timeout 10 $BIN/priamos topic echo CLAIM --count 1 > /dev/null
    probe() { echo "--- $1"; on base $BIN/priamos doctor --seconds 0.5 "${@:2}" | grep -A1 -E ' (way|host) ' ; }
    probe whole --probe
    cut_bus base; probe bus --probe; whole base
    cut_off base; probe from --expect vision
    whole base; cut_off vision
    BEGIN=$(date +%s%N)
    on base $BIN/priamos doctor --probe > $DIR/to; CODE=$?; echo "--- to"; echo "exit $CODE after $((($(date +%s%N) - BEGIN) / 1000000)) ms"
    cat $DIR/to
  )sh");
  EXPECT_THAT(Part(answer, "whole"),
              ContainsRegex("host vision \\(10.77.0.2\\) +both ways work: [12] of [12] "
                            "questions answered, by 1 process, by eth9 with ttl 1"));
  EXPECT_THAT(Part(answer, "bus"),
              ContainsRegex("BAD +way from vision \\(10.77.0.2\\) to here cut: it answers [12] of [12]"));
  EXPECT_THAT(Part(answer, "from"), ContainsRegex("BAD +way from vision to here +cut, or it is off"));
  EXPECT_THAT(Part(answer, "to"),
              ContainsRegex("BAD +way from here to vision \\(10.77.0.2\\) cut: it is heard, but"));
  EXPECT_THAT(Part(answer, "to"), ContainsRegex("exit 1 after [0-9]{4} ms")) << "2.7 s on an idle machine";
}

/// A process that ended, or hung, before clocks were compared leaves a clock that is not known.
TEST_F(Hosts, AProbeIsAnsweredWhateverIsKnownOfTheClockOfTheHostThatAsks) {
  const auto answer = RunOnHosts(R"sh(
    host base 10.77.0.1; host vision 10.77.0.2
    export PRIAMOS_BUS=onboard PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9
    start vision $BIN/priamos-robot --config $SIM/robot.toml 2> /dev/null
    on vision timeout 10 $BIN/priamos topic echo CLAIM --count 1 > /dev/null
    on base $BIN/priamos topic pub CLOCK clock_report_t '{"utime":1000000,"clock_id":7,"host":"base","count":0}' > /dev/null
    echo "--- probe"; on base $BIN/priamos doctor --seconds 0.5 --probe | grep -E ' (way|host) '
  )sh");
  EXPECT_THAT(Part(answer, "probe"), HasSubstr("both ways work"));
}

/// One process on each of two computers whose clocks are a second apart.
TEST_F(Hosts, AClockThatIsASecondAheadIsMeasuredAndItsStampsAreTranslated) {
  const auto answer = RunOnHosts(R"sh(
    host base 10.77.0.1 0; host vision 10.77.0.2 1000000
    export PRIAMOS_BUS=onboard PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9
    start base timeout 30 $BIN/priamos topic echo CLOCK host ahead_s uncertainty_s --json > $DIR/clocks 2> /dev/null
    start base timeout 30 $BIN/priamos topic echo ODOMETRY utime --count 100 > $DIR/odometry 2> /dev/null; EAR=$STARTED
    start vision timeout 30 $BIN/priamos topic echo WHEEL_STATE utime --count 100 > $DIR/wheels 2> /dev/null; OTHER=$STARTED
    start base timeout 30 $BIN/priamos topic echo HEALTH process clock_ahead_s clock_uncertainty_s --json > $DIR/health 2> /dev/null
    start vision $BIN/priamos-world --config $SIM/world.toml 2> /dev/null
    start base $BIN/priamos-robot --config $SIM/robot.toml 2> /dev/null
    wait $EAR $OTHER
    echo "--- odometry"; tail -1 $DIR/odometry; echo "--- wheels"; tail -1 $DIR/wheels
    echo "--- probe"; on base $BIN/priamos doctor --probe --seconds 1 | grep 'host vision'
    echo "--- clocks"; grep '"base"' $DIR/clocks | tail -1
    for process in robot world; do echo "--- $process"; grep "\"$process\"" $DIR/health | tail -1; done
    echo "--- end"
  )sh");
  const auto robot = nlohmann::json::parse(Part(answer, "robot"), nullptr, false),
             world = nlohmann::json::parse(Part(answer, "world"), nullptr, false);
  ASSERT_TRUE(robot.is_object() && world.is_object()) << answer.text;
  // own_clock of computers.sh reads two clocks by two processes: the true second is some milliseconds off.
  EXPECT_NEAR(world.value("clock_ahead_s", 0.0) - robot.value("clock_ahead_s", 0.0), 1, 0.04)
      << "one of them is the reference; " << answer.text;
  for (const auto& health : {robot, world}) {
    EXPECT_GE(health.value("clock_uncertainty_s", -1.0), 0) << answer.text;
    EXPECT_LE(health.value("clock_uncertainty_s", -1.0), 0.02);
  }
  EXPECT_THAT(Part(answer, "probe"),
              ContainsRegex("its clock is (0.9[0-9]*|1.0[0-3][0-9]*) s ahead, to [0-9]"));
  EXPECT_THAT(Part(answer, "clocks"), ContainsRegex("\"ahead_s\":\\[(1.0|0.9)"));
  const double odometry_s = std::stod(Part(answer, "odometry")) / 1e6,
               wheels_s = std::stod(Part(answer, "wheels")) / 1e6;
  EXPECT_NEAR(wheels_s - odometry_s, 1, 0.9)
      << "odometry has the stamp of the wheels, by the clock of its own host";
  EXPECT_GT(std::stod(Part(answer, "odometry")), 1e15) << answer.text;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

/// Virtual machines of one snapshot: one boot, one anchor, one name; their clocks have drifted apart.
TEST_F(Hosts, ClocksOfCopiedMachinesAreToldApart) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes no library that is loaded before it";
  const auto answer = RunOnHosts("SHIM=" PRIAMOS_BINARY_DIR
                                 "/test/libother_clock.so\n"
                                 R"sh(
    host base 10.77.0.1; host copy 10.77.0.2; on copy hostname base
    export PRIAMOS_BUS=onboard PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9 PRIAMOS_RUNTIME=$DIR/snapshot
    ENV_copy="LD_PRELOAD=$SHIM OTHER_CLOCK_AHEAD_S=2"
    start base timeout 30 $BIN/priamos topic echo ODOMETRY utime --count 100 > $DIR/odometry 2> /dev/null; HERE=$STARTED
    start copy timeout 30 $BIN/priamos topic echo WHEEL_STATE utime --count 100 > $DIR/wheels 2> /dev/null; THERE=$STARTED
    start copy $BIN/priamos-world --config $SIM/world.toml 2> /dev/null
    start base $BIN/priamos-robot --config $SIM/robot.toml 2> /dev/null
    wait $HERE $THERE
    echo "--- odometry"; tail -1 $DIR/odometry; echo "--- wheels"; tail -1 $DIR/wheels
    echo "--- probe"; on base $BIN/priamos doctor --probe --seconds 1 | grep 'host base'
    echo "--- end"; ls $DIR/snapshot
  )sh");
  const double odometry_s = std::atof(Part(answer, "odometry").c_str()) / 1e6,
               wheels_s = std::atof(Part(answer, "wheels").c_str()) / 1e6;
  ASSERT_GT(odometry_s, 1e9) << answer.text;
  EXPECT_NEAR(wheels_s - odometry_s, 2, 0.9)
      << "odometry has the stamp of the wheels, by the clock of its own host; " << answer.text;
  EXPECT_THAT(Part(answer, "probe"), ContainsRegex("its clock is (2.0000|1.9[0-9]*|2.00[0-9]*) s ahead"));
}

/// How many messages of `answer` were stamped more than 50 ms from the time at which they were heard.
int WronglyStamped(const ShellAnswer& answer, const std::string& name) {
  int wrong = 0;
  std::istringstream lines(Part(answer, name));
  for (double heard_s = 0, utime = 0; lines >> heard_s >> utime;)
    wrong += std::abs(heard_s - utime / 1e6) > 0.05 ? 1 : 0;
  return wrong;
}

/// As of a virtual machine that was paused, or whose clock was set right behind its back.
TEST_F(Hosts, StampsOfAClockThatStepsAreNotHandedOnWrong) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes no library that is loaded before it";
  const auto answer = RunOnHosts("SHIM=" PRIAMOS_BINARY_DIR
                                 "/test/libother_clock.so\n"
                                 R"sh(
    export PRIAMOS_BUS=onboard PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9 PYTHONDONTWRITEBYTECODE=1
    step() {  # NAME MS
      host base 10.77.0.1; host vision 10.77.0.2
      local at=$(($(cut -d. -f1 /proc/uptime) + 4))
      ENV_vision="LD_PRELOAD=$SHIM OTHER_CLOCK_JUMP_AT_S=$at OTHER_CLOCK_JUMP_MS=$2"
      start base $BIN/priamos log record $DIR/$1.lcmlog --seconds 7 --no-health > /dev/null; local log=$STARTED
      start base $BIN/priamos-planner --config $SIM/planner.toml 2> /dev/null
      start base timeout 7 $BIN/priamos topic echo HEALTH process text --json > $DIR/$1.health 2> /dev/null
      start vision $BIN/priamos-world --config $SIM/world.toml 2> /dev/null
      wait $log; off
      echo "--- $1"; PYTHONPATH=$SOURCE/bus/python python3 -c '
import sys, priamos_bus
for event, message in priamos_bus.Log(sys.argv[1]).messages("WHEEL_STATE"):
    print("%.6f %d" % (event.utime / 1e6, message["utime"]))' $DIR/$1.lcmlog
      echo "--- health $1"; grep planner $DIR/$1.health
    }
    step back -1000; step forward 1000; step little -100; echo "--- end"
  )sh");
  for (const std::string name : {"back", "forward", "little"}) {
    const auto stamps = Part(answer, name);
    EXPECT_GT(std::count(stamps.begin(), stamps.end(), '\n'), 200) << name;
    EXPECT_EQ(WronglyStamped(answer, name), 0) << name;
  }
  EXPECT_THAT(Part(answer, "health forward"), HasSubstr("its clock stepped"));
}

TEST_F(Hosts, TheDoorIsPassedWithProcessesOnThreeComputersOfDifferentClocks) {
  const auto answer =
      RunShell("timeout 120 " PRIAMOS_SOURCE_DIR "/scripts/door-over-hosts --clocks 1 --seed 3 --into '" +
               folder_.path().string() + "/door' --programs " PRIAMOS_BINARY_DIR "/bin");
  std::ifstream runs(folder_ / "door/runs.jsonl");
  const auto run = nlohmann::json::parse(runs, nullptr, false);
  ASSERT_TRUE(run.is_object()) << answer.text;
  ASSERT_TRUE(run["passed"]) << run["reason"] << answer.text;
  EXPECT_EQ(run["contacts"], 0);
  EXPECT_LT(std::abs(run["lateral_at_door_m"].get<double>()), 0.05);
}

/// A deployment over two computers; the planner stands for any process, and needs the least.
constexpr const char* kOverTwo = R"sh(
host base 10.77.0.1; host vision 10.77.0.2
mkdir $DIR/two; cp -r $SIM/robot.toml $SIM/planner.toml $SIM/teleop.toml $SIM/maps $DIR/two
cat > $DIR/two/deployment.toml << 'END'
onboard_ttl = 1
onboard_network = "eth9"
offboard_ttl = 1
offboard_network = "eth9"
[[process]]
module = "robot"
bus = "onboard"
config = "robot.toml"
host = "base"
[[process]]
module = "planner"
bus = "offboard"
config = "planner.toml"
after = "onboard-robot"
host = "vision"
[[process]]
module = "teleop"
bus = "offboard"
config = "teleop.toml"
END
up() { on $1 $BIN/priamos up $DIR/two/ --host $2 --logs $DIR/$3 --detach 2>&1; echo "exit $?"; }
)sh";

TEST_F(Hosts, EachStartsItsPartOfADeployment) {
  const auto answer = RunOnHosts(std::string(kOverTwo) + R"sh(
    trap 'on base $BIN/priamos down --logs $DIR/b; on vision $BIN/priamos down --logs $DIR/v; off' EXIT
    echo "--- wrong"; up base visoin w
    echo "--- base"; up base base b
    echo "--- vision"; up vision vision v
    echo "--- twice"; up vision base w
    echo "--- end"
  )sh");
  EXPECT_THAT(
      Part(answer, "wrong"),
      AllOf(
          HasSubstr("expected a host of the deployment (base, vision), got \"visoin\"; nearest: \"vision\""),
          HasSubstr("exit 2")));
  EXPECT_THAT(Part(answer, "base"), AllOf(HasSubstr("onboard-robot"), HasSubstr("offboard-teleop"),
                                          Not(HasSubstr("planner")), HasSubstr("exit 0")));
  EXPECT_THAT(Part(answer, "vision"), AllOf(HasSubstr("offboard-planner"), HasSubstr("offboard-teleop"),
                                            Not(HasSubstr("robot")), HasSubstr("exit 0")));
  EXPECT_THAT(Part(answer, "twice"),
              ContainsRegex("no other `up-base` of robot priamos, got pid [0-9]+ on base"));
}

/// Each robot on a computer of its own, on one switch; every one of their buses reaches the other computer.
TEST_F(Hosts, TwoRobotsInOneNetworkNeverHearEachOther) {
  const auto answer = RunOnHosts(R"sh(
    host anna 10.77.0.1; host berta 10.77.0.2
    export PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9
    module() { start $1 $BIN/priamos-$2 --config $SIM/$2.toml --robot $1 --bus $3 2> $DIR/$1-$2; }
    for r in anna berta; do module $r robot onboard; module $r planner offboard; module $r teleop offboard; done
    sleep 0.6
    EARS=
    for h in anna berta; do for r in anna berta; do for b in onboard offboard; do
      start $h $BIN/priamos topic list --json --seconds 1.6 --robot $r --bus $b > $DIR/at-$h-$r-$b 2> /dev/null
      EARS="$EARS $STARTED"
    done; done; done
    wait $EARS
    for h in anna berta; do for r in anna berta; do for b in onboard offboard; do
      echo "--- $h $r $b"; cat $DIR/at-$h-$r-$b; done; done; done
    echo "--- end"; cat $DIR/anna-* $DIR/berta-*
  )sh");
  for (const std::string host : {"anna", "berta"}) {
    for (const std::string robot : {"anna", "berta"}) {
      for (const std::string bus : {"onboard", "offboard"}) {
        const std::string own = robot == "anna" ? "10.77.0.1:" : "10.77.0.2:";
        const auto text = Part(answer, fmt::format("{} {} {}", host, robot, bus));
        ASSERT_TRUE(nlohmann::json::accept(text)) << text;
        int heard = 0, foreign = 0;
        const auto list = nlohmann::json::parse(text);
        for (const auto& sender : list["senders"]) {
          const bool is_own = sender["address"].get<std::string>().starts_with(own);
          (is_own ? heard : foreign) += sender["datagrams"].get<int>();
        }
        EXPECT_GT(heard, 2) << robot << "'s " << bus << " bus, heard at " << host;
        EXPECT_EQ(foreign, 0) << robot << "'s " << bus << " bus, heard at " << host;
      }
    }
  }
}

/// The robot behind the radio, which ends at the first workstation; each workstation has a console of its
/// own.
TEST_F(Hosts, TwoWorkstationsSeeTheRobotAndOneDrivesUntilTheOtherTakesOver) {
  const auto answer = RunOnHosts(R"sh(
    host base 10.77.0.1; host desk 10.77.0.2; host second 10.77.0.3
    export PRIAMOS_TTL=1 PRIAMOS_NETWORK=eth9 PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$SOURCE/test/support
    $BIN/priamos link emulate --a $DIR/tty-onboard --b $DIR/tty-offboard > /dev/null 2>&1 & RUNNING=$!
    until [ -e $DIR/tty-offboard ]; do sleep 0.02; done
    module() { start $1 $BIN/priamos-$2 --config $SIM/$2.toml --bus $3 "${@:4}" 2> $DIR/$1-$2; }
    module base world onboard; module base robot onboard --set state_file=$DIR/state
    module base radio onboard --set side=onboard --set port=$DIR/tty-onboard
    module desk radio offboard --set side=offboard --set port=$DIR/tty-offboard
    PAGES=
    for desk in desk second; do module $desk console offboard --set port=0; done
    for desk in desk second; do
      until grep -q 'http://127.0.0.1:' $DIR/$desk-console; do sleep 0.05; done
      start $desk python3 $SOURCE/test/support/workstation.py $([ $desk = desk ] && echo first || echo second) \
        $(grep -o '127.0.0.1:[0-9]*' $DIR/$desk-console | cut -d: -f2) $DIR; PAGES="$PAGES $STARTED"
    done
    start second timeout 30 $BIN/priamos topic echo POSE x_m --bus offboard --count 3 > $DIR/poses 2>&1; PAGES="$PAGES $STARTED"
    wait $PAGES
    echo "--- poses"; grep -c '^-*[0-9]' $DIR/poses; echo "--- said"; cat $DIR/*-console $DIR/*-radio $DIR/*-robot
  )sh");
  for (const char* seen : {"first sees the robot: True", "second sees the robot: True", "first drives: True",
                           "second asks: True", "second drives unasked: False", "first kept the lease: True",
                           "second takes over: True", "first is told who has it now: True"})
    EXPECT_THAT(answer.text, HasSubstr(seen));
  EXPECT_EQ(Part(answer, "poses"), "3\n");
}

TEST_F(Hosts, LcmsDefaultAddressIsNeverOursSilently) {
  const auto answer = Run(R"sh(
    timeout -s INT 1 $BIN/priamos-robot --config $SIM/robot.toml --bus udpm:// 2> $DIR/none &
    timeout -s INT 1 $BIN/priamos-head --config $SIM/head.toml --bus 'udpm://239.255.76.67:7667?ttl=0' 2> $DIR/lcms &
    timeout -s INT 1 $BIN/priamos-robot --config $SIM/robot.toml --bus onboard 2> $DIR/ours &
    wait
    for bus in none lcms ours; do echo "--- $bus"; cat $DIR/$bus; done
  )sh");
  EXPECT_THAT(Part(answer, "none"), HasSubstr("every LCM program that was told no address uses this one"));
  EXPECT_THAT(Part(answer, "lcms"), HasSubstr("next: --bus onboard"));
  EXPECT_THAT(Part(answer, "ours"), Not(HasSubstr("every LCM program")));
}

/// The wall clock cannot be set by a test, so the second process is shown another one: libother_clock.
TEST_F(Hosts, AWallClockThatIsSetBetweenTwoStartsLeavesStampsAligned) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes no library that is loaded before it";
  const auto answer = Run(R"sh(
    SHIM=)sh" PRIAMOS_BINARY_DIR R"sh(/test/libother_clock.so
    timeout 20 $BIN/priamos topic echo HEALTH process utime --bus onboard --count 5 --json & EAR=$!
    listening
    $BIN/priamos-robot --config $SIM/robot.toml --bus onboard & FIRST=$!
    until [ -e $DIR/runtime ]; do sleep 0.02; done
    OTHER_CLOCK_STEP_S=3600 LD_PRELOAD=$SHIM $BIN/priamos-teleop --config $SIM/teleop.toml --bus onboard & SECOND=$!
    PRIAMOS_RUNTIME=$DIR/own OTHER_CLOCK_STEP_S=3600 LD_PRELOAD=$SHIM $BIN/priamos-planner --config $SIM/planner.toml --bus onboard & OTHER=$!
    wait $EAR
    kill $FIRST $SECOND $OTHER; wait $FIRST $SECOND $OTHER
    echo "--- doctor"; OTHER_CLOCK_STEP_S=3600 LD_PRELOAD=$SHIM $BIN/priamos doctor --bus onboard | grep -A1 'clock of processes'
    ls $DIR/runtime
  )sh");
  std::map<std::string, double> stamp_s;
  const std::regex health(
      "\"process\":\"([a-z]+)\",\"utime\":([0-9]+)|\"utime\":([0-9]+),\"process\":\"([a-z]+)\"");
  for (std::sregex_iterator at(answer.text.begin(), answer.text.end(), health), end; at != end; ++at) {
    const bool named_first = (*at)[1].matched;
    stamp_s[named_first ? (*at)[1] : (*at)[4]] = std::stod(named_first ? (*at)[2] : (*at)[3]) / 1e6;
  }
  ASSERT_EQ(stamp_s.size(), 3U) << answer.text;
  EXPECT_NEAR(stamp_s["robot"], stamp_s["teleop"], 2) << "one anchor per host and boot";
  EXPECT_NEAR(stamp_s["planner"] - stamp_s["robot"], 3600, 5) << "without it they would be an hour apart";
  EXPECT_THAT(answer.text,
              ContainsRegex("note +clock of processes +all agree, but the wall clock was set .* 3600.. s "
                            "ahead"));
}

}  // namespace
}  // namespace priamos
