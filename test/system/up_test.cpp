// `priamos up`, `status`, `logs` and `down` as a person types them, with the real processes of config/sim.

#include <gmock/gmock.h>

#include <fstream>
#include <regex>

#include "test/system/robot_shell.hpp"

namespace priamos {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// `pids` of everything that is up; `running PID...` prints those that run (a zombie does not); `gone PID...`
// waits 3 s for their end and prints who is left.
const std::string kHelpers = R"sh(
up() { $BIN/priamos up $SOURCE/config/sim --logs $LOGS "$@"; }
# In the background; a shell would let it ignore Ctrl-C.
start() { env --default-signal=INT $BIN/priamos up $SOURCE/config/sim --logs $LOGS > $1 & UP=$!; ready; }
verb() { local v=$1; shift; $BIN/priamos $v --logs $LOGS "$@"; }
pids() { grep -o '"pid": [1-9][0-9]*' $LOGS/up.json | cut -d' ' -f2; }
running() { for p in "$@"; do grep -qs '^State:[[:space:]]*[^ZX]' /proc/$p/status && echo $p; done; }
gone() {
  for i in $(seq 60); do [ -z "$(running "$@")" ] && break; sleep 0.05; done
  echo "left: $(running "$@" | wc -l)"
}
ready() {
  for i in $(seq 400); do verb status > /dev/null && return; sleep 0.05; done
  echo never ready; cat $LOGS/*/*.txt
}
)sh";

class UpTest : public RobotShell {
 protected:
  UpTest() : RobotShell(kHelpers) {}
};

TEST_F(UpTest, BringsEverythingUpStartsAgainWhatDiedTellsWhyAndEndsWithoutOrphans) {
  const auto answer = RunScript(R"sh(
    up --detach || echo failed
    P=$(pids); echo "processes: $(echo $P | wc -w), running: $(running $P | wc -w)"
    up && echo a second one
    ROBOT=$(pid_of onboard-robot); kill -9 $ROBOT; gone $ROBOT
    ready; verb status; echo "status: $?"
    P=$(pids); verb logs onboard-robot
    verb logs nobody; echo "nobody: $?"
    verb down; echo "down: $?"
    gone $P
    verb status; echo "status: $?"
    verb down; echo "down: $?"
  )sh");
  EXPECT_THAT(answer.text, HasSubstr("processes: 9, running: 9\n"));
  EXPECT_THAT(answer.text, HasSubstr("expected nothing up, got `priamos up` with pid"));
  EXPECT_THAT(answer.text, Not(HasSubstr("a second one")));
  EXPECT_THAT(answer.text, ContainsRegex("onboard-robot +onboard +ready +[0-9]+ +[0-9.]+ s +2\n"));
  EXPECT_THAT(answer.text, HasSubstr("onboard-robot last ended: killed by signal 9"));
  EXPECT_THAT(answer.text, HasSubstr("status: 0"));
  EXPECT_THAT(answer.text, AllOf(HasSubstr("--- start 1"), HasSubstr("--- start 2")))
      << "its console is kept";
  EXPECT_THAT(answer.text, HasSubstr("nobody: 2"));
  EXPECT_THAT(answer.text, HasSubstr("everything is down\ndown: 0\nleft: 0\n"));
  EXPECT_THAT(answer.text, HasSubstr("nothing is up\nstatus: 1\nnothing is up\ndown: 0\n"));
  EXPECT_THAT(answer.text, Not(HasSubstr("failed")));
}

TEST_F(UpTest, RestartsByOrderAlsoThroughTheRadioAndReadsConsolesThere) {
  const auto answer = RunScript(R"sh(
    up --detach > /dev/null || echo failed
    TELEOP=$(pid_of offboard-teleop); HEAD=$(pid_of onboard-head)
    $BIN/priamos restart offboard-teleop; echo "teleop: $?"
    $BIN/priamos restart onboard-head; echo "head: $?"
    $BIN/priamos restart onboard-heed; echo "heed: $?"
    sleep 0.5; verb status
    [ $TELEOP != $(pid_of offboard-teleop) ] && [ $HEAD != $(pid_of onboard-head) ] && echo other pids
    $BIN/priamos logs onboard-head --logs $LOGS.empty -n 2 | grep -cE '^onboard-head +(--- start 2|[0-9:.]+ head: )'
    $BIN/priamos estop --rearm > /dev/null
    $BIN/priamos restart onboard-robot; sleep 3
    $BIN/priamos topic echo DRIVE_STATUS estop --count 1
    verb down
  )sh",
                                120);
  EXPECT_THAT(answer.text, ContainsRegex("offboard-teleop runs again after [0-9.]+ s\nteleop: 0"));
  EXPECT_THAT(answer.text, ContainsRegex("onboard-head runs again after [0-9.]+ s\nhead: 0"));
  EXPECT_THAT(answer.text, HasSubstr("unknown process \"onboard-heed\"; nearest: \"onboard-head\""));
  EXPECT_THAT(answer.text, HasSubstr("heed: 1"));
  EXPECT_THAT(answer.text, ContainsRegex("onboard-head +onboard +ready +[0-9]+ +[0-9.]+ s +2\n"));
  EXPECT_THAT(answer.text, AllOf(HasSubstr("other pids"), HasSubstr("\n2\n")));
  EXPECT_THAT(answer.text, ContainsRegex("onboard-robot runs again after [0-9.]+ s\ntrue\n"))
      << "what drives begins stopped";
  EXPECT_THAT(answer.text, Not(HasSubstr("failed")));
}

TEST_F(UpTest, WithoutMulticastSaysSoAtOnce) {
  const auto answer = RunScript(R"sh(
    ip route del 224.0.0.0/4
    TIMEFORMAT='took %R s'
    time up --detach; echo "code: $?"
    verb status
  )sh");
  EXPECT_THAT(answer.text, AllOf(HasSubstr("expected a multicast route"), HasSubstr("code: 2"),
                                 HasSubstr("nothing is up")));
  std::smatch took;
  ASSERT_TRUE(std::regex_search(answer.text, took, std::regex("took ([0-9.]+) s"))) << answer.text;
  EXPECT_LT(std::stod(took[1]), 5) << "2 s, on a machine that has time";
}

TEST_F(UpTest, LeavesNoOrphanAfterCtrlCNorAfterItsOwnDeathAndComesUpAgain) {
  const auto answer = RunScript(R"sh(
    start $LOGS.first; P=$(pids)
    kill -INT $UP; wait $UP; echo "Ctrl-C: $?"; gone $P
    start $LOGS.second; P=$(pids)
    kill -STOP $(pid_of onboard-robot); kill -9 $UP; wait $UP; gone $P
    verb status; up --detach > /dev/null && verb down
    cat $LOGS.first
  )sh");
  EXPECT_THAT(answer.text, HasSubstr("Ctrl-C: 0\nleft: 0\n"));
  EXPECT_THAT(answer.text, HasSubstr("left: 0\nnothing is up\neverything is down\n")) << "also a stopped one";
  EXPECT_THAT(answer.text, AllOf(HasSubstr("onboard-robot is ready"), HasSubstr("all processes are ready"),
                                 HasSubstr("going down")))
      << "progress is shown";
}

TEST_F(UpTest, WhileItIsStoppedItsProcessesGoOnAndAfterwardsNobodyIsBlamed) {
  const auto answer = RunScript(R"sh(
    start $LOGS.out
    kill -STOP $UP; sleep 2
    $BIN/priamos topic hz POSE --bus onboard --seconds 1
    kill -CONT $UP; sleep 1.5
    verb status; verb down; wait $UP
  )sh");
  std::smatch rate;
  ASSERT_TRUE(std::regex_search(answer.text, rate, std::regex("POSE +priamos.pose_t +([0-9.]+)")))
      << answer.text;
  EXPECT_GT(std::stod(rate[1]), 25) << "50 poses a second on a machine that has time";
  EXPECT_THAT(answer.text, Not(HasSubstr("hung")));
  EXPECT_THAT(answer.text, ContainsRegex("onboard-robot +onboard +ready +[0-9]+ +[0-9.]+ s +1\n"));
}

}  // namespace
}  // namespace priamos
