// One owner per role, robot and bus, with the real programs in a network of their own.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <regex>

#include "bus/wire/bus_address.hpp"
#include "test/system/robot_shell.hpp"

namespace priamos {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const std::string kHelpers = R"sh(
SIM=$SOURCE/config/sim
# A second process of a module: what it says, and how it ended.
second() {
  echo "first: pid $(pid_of $1-$2) on"
  timeout 10 $BIN/priamos-$2 --config $SIM/$2.toml --bus $1; echo "exit $?"
}
# One field of the newest message of a channel.
field() { $BIN/priamos topic echo $1 --bus onboard --count 1 --json | grep -o "\"$2\":[^,}]*" | head -1; }
rate() { $BIN/priamos topic hz $1 --bus onboard --seconds 2 | grep -E "^$1 "; }
holds() {
  for i in $(seq 100); do
    $BIN/priamos topic echo CLAIM --bus $1 --count 5 --json | grep "\"role\":\"$2\"" | grep -q '"state":1' && return
  done
  echo "nobody holds $2"
}
)sh";

class Owners : public RobotShell {
 protected:
  Owners() : RobotShell(kHelpers) {}
};

int CountOf(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  return static_cast<int>(std::distance(std::sregex_iterator(text.begin(), text.end(), regex), {}));
}

TEST_F(Owners, ASecondOfEveryRoleIsRefusedAndNamesTheFirst) {
  const auto answer = RunScript(R"sh(
    trap '$BIN/priamos down --logs $LOGS' EXIT  # also when the time is over
    $BIN/priamos up $SIM --logs $LOGS --detach > /dev/null || echo failed
    for m in world robot head radio; do second onboard $m; done
    for m in planner radio; do second offboard $m; done
    echo --- up; $BIN/priamos up $SIM --logs $LOGS.elsewhere; echo "exit $?"
    echo --- run; $BIN/priamos run --deployment $SIM --robot priamos --logs $LOGS.run; echo "exit $?"
  )sh",
                                110);
  // The first is named by its process.
  const std::regex first("first: (pid [0-9]+ on)");
  for (std::sregex_iterator at(answer.text.begin(), answer.text.end(), first), end; at != end; ++at)
    EXPECT_EQ(CountOf(answer.text, "got " + (*at)[1].str() + " .*, since 20.*; end that one first"), 1)
        << answer.text;
  EXPECT_EQ(CountOf(answer.text, "first: pid"), 6);
  EXPECT_EQ(CountOf(answer.text, "exit 2\n"), 8) << answer.text;
  EXPECT_EQ(CountOf(answer.text, "no other `supervisor` of robot priamos, got pid"), 2) << answer.text;
  EXPECT_THAT(answer.text, AllOf(HasSubstr("everything is down"), Not(HasSubstr("failed"))));
}

TEST_F(Owners, ARunBesideARobotMeetsNobodyAndMovesOnlyItsOwn) {
  const auto answer = RunScript(R"sh(
    $BIN/priamos-world --config $SIM/world.toml & WORLD=$!
    holds onboard world
    $BIN/priamos-robot --config $SIM/robot.toml & ROBOT=$!
    holds onboard robot
    echo "before $(field WORLD_TRUTH x_m)"
    $BIN/priamos run --deployment $SIM --logs $LOGS.run > $LOGS.out 2>&1 & RUN=$!
    running() { kill -0 $RUN 2> /dev/null; }
    # It drives: that is what must not reach the first one.
    while running && ! grep -q 'order to the planner' $LOGS.out; do sleep 0.1; done
    OWN=$(grep -o -m1 'run-[0-9a-f]*' $LOGS.out | head -1)
    own() { timeout 3 $BIN/priamos topic echo WORLD_TRUTH --robot $OWN --bus onboard --count 1 --json; }
    while running && ! own | grep -qE '"vx_m_s":0\.[1-9]'; do sleep 0.1; done
    echo "after $(field WORLD_TRUTH x_m)"; rate POSE
    kill -INT $RUN; wait $RUN
    kill $ROBOT $WORLD; wait $ROBOT $WORLD
    head -2 $LOGS.out
  )sh",
                                110);
  std::smatch before, after, rate;
  ASSERT_TRUE(std::regex_search(answer.text, before, std::regex("before \"x_m\":([-0-9.e]+)")))
      << answer.text;
  ASSERT_TRUE(std::regex_search(answer.text, after, std::regex("after \"x_m\":([-0-9.e]+)"))) << answer.text;
  EXPECT_EQ(before[1], after[1]) << "the first one has not moved";
  ASSERT_TRUE(std::regex_search(answer.text, rate, std::regex("POSE +priamos.pose_t +([0-9.]+)")))
      << answer.text;
  EXPECT_LT(std::stod(rate[1]), 60) << "one sender";
  EXPECT_THAT(answer.text, ContainsRegex("robot run-[0-9a-f]{4}, .*priamos topic list --watch --robot run-"));
}

TEST_F(Owners, TheWorldNeverSpeaksBesideDrivers) {
  const auto answer = RunScript(R"sh(
    LOG=$SOURCE/logs/recorded/door-onboard.lcmlog
    play() { $BIN/priamos log play $LOG --bus onboard --channels "$1" --loop > /dev/null 2>&1 & PLAYER=$!; }
    world() { timeout 20 $BIN/priamos-world --config $SIM/world.toml; echo "exit $?"; }
    play SONAR_RANGES; sleep 1
    world
    kill $PLAYER; wait $PLAYER
    $BIN/priamos topic echo ALARM --bus onboard --count 1 > $LOGS.alarm & ECHO=$!
    world > $LOGS.world 2>&1 & WORLD=$!
    holds onboard world
    play WHEEL_STATE
    wait $WORLD; kill $PLAYER; wait $PLAYER $ECHO
    cat $LOGS.world $LOGS.alarm
  )sh");
  EXPECT_THAT(answer.text, ContainsRegex("expected nobody to send SONAR_RANGES beside `world`, got messages "
                                         "from (localhost|[0-9.]+):[0-9]+: .*\nexit 2"));
  EXPECT_THAT(answer.text, ContainsRegex("expected nobody to send WHEEL_STATE beside `world`.*\nexit 1"));
  EXPECT_THAT(answer.text, HasSubstr("\"source\": \"world\""));
}

TEST_F(Owners, ClaimsOfALogAreNotPlayed) {
  const auto answer = RunScript(R"sh(
    cd $(dirname $LOGS)
    $BIN/priamos-robot --config $SIM/robot.toml & ROBOT=$!
    holds onboard robot
    timeout -s INT 3 $BIN/priamos log record a.lcmlog --bus onboard > /dev/null 2>&1
    kill $ROBOT; wait $ROBOT
    $BIN/priamos log info a.lcmlog | grep -o '^ *CLAIM'
    $BIN/priamos log play a.lcmlog --bus onboard --loop > /dev/null 2>&1 & PLAYER=$!
    echo "health: $(timeout 5 $BIN/priamos topic echo HEALTH --bus onboard --count 1 --json | grep -c process)"
    echo "claims: $(timeout 3 $BIN/priamos topic echo CLAIM --bus onboard --count 1 --json 2> /dev/null | wc -l)"
    kill $PLAYER; wait $PLAYER
  )sh");
  EXPECT_THAT(answer.text, HasSubstr("CLAIM\n")) << "they are recorded";
  EXPECT_THAT(answer.text, HasSubstr("health: 1\nclaims: 0\n"));
}

TEST_F(Owners, TwoNamesThatLeadToOneAddressAreNotTakenForOneRobot) {
  const std::string other = "r2281000";
  ASSERT_EQ(bus::BusUrl(other, bus::BusSide::kOnboard, 0),
            bus::BusUrl(bus::kDefaultRobot, bus::BusSide::kOnboard, 0));
  const auto answer = RunScript("OTHER=" + other + R"sh(
    $BIN/priamos-robot --config $SIM/robot.toml & FIRST=$!
    holds onboard robot
    timeout 10 $BIN/priamos-head --config $SIM/head.toml --robot $OTHER; echo "exit $?"
    kill $FIRST; wait $FIRST
  )sh");
  EXPECT_THAT(answer.text, ContainsRegex("expected no robot but " + other +
                                         ", got `robot` of robot priamos, pid [0-9]+ on .*: both names lead "
                                         "to the same address; take another name with --robot\nexit 2"));
}

/// Whoever is left, the wheels never obey two: bench_owners in its short form.
TEST_F(Owners, WhenTwoMeetAllTheSameOneYieldsAndTheWheelsObeyNeitherMeanwhile) {
  const auto answer = RunScript("$BIN/bench_owners --trials 2", 110);
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("\npassed\n")) << answer.text;
}

}  // namespace
}  // namespace priamos
