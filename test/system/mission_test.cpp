// `priamos mission` and `priamos where` as a person at the workstation types them, beside the real processes.

#include <gmock/gmock.h>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST(Mission, IsOrderedRefusedFollowedAndAborted) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork(R"sh(
    PATH=$BIN:$PATH; LOGS=)sh" + (folder / "logs").string() +
                                              R"sh(
    MAP="--deployment $SOURCE/config/sim"
    priamos mission door laboratory $MAP; echo "nothing up: $?"
    priamos up $SOURCE/config/sim --detach --logs $LOGS > /dev/null
    for i in $(seq 200); do priamos status --logs $LOGS > /dev/null && break; sleep 0.2; done
    priamos mission abort; echo "nothing to abort: $?"
    priamos mission door 9 $MAP; echo "no such door: $?"
    priamos mission door 9 $MAP; echo "again: $?"
    priamos mission door laboratory $MAP; echo "ordered: $?"
    priamos mission goto 8.3 1.2; echo "second: $?"
    priamos mission pause; echo "pause: $?"
    priamos mission list | sed 's/^ *[0-9]*/N/'; echo "list: $?"
    priamos mission resume; echo "resume: $?"
    priamos where; echo "offboard: $?"; priamos where --bus onboard; echo "onboard: $?"
    priamos mission status --wait > /dev/null & follower=$!
    sleep 1; priamos mission abort; echo "abort: $?"; wait $follower; echo "followed: $?"
    priamos mission status; echo "status: $?"
    priamos down --logs $LOGS
  )sh",
                                          folder / "script.sh", 90);
  const std::string& text = answer.text;
  EXPECT_THAT(text, ContainsRegex("mission door: no answer: no planner is heard\nnothing up: 1"));
  EXPECT_THAT(text, HasSubstr("done: no mission was under way; the robot is told to stand: the robot "
                              "stands\nnothing to abort: 0"));
  EXPECT_THAT(text, HasSubstr("failed: the map has no door 9\nno such door: 1"));
  EXPECT_THAT(text, HasSubstr("failed: the map has no door 9\nagain: 1"));
  EXPECT_THAT(text, ContainsRegex("accepted: approaching door 'laboratory'.*\nordered: 0"));
  EXPECT_THAT(text, ContainsRegex("accepted: order [0-9]+ waits, 1 before it\nsecond: 0"));
  EXPECT_THAT(text, ContainsRegex("done: paused: the robot stands.*\npause: 0"));
  EXPECT_THAT(text,
              ContainsRegex("N  paused     door 'laboratory': .*\nN  waits      goto \\(8.30, 1.20\\)\n"));
  EXPECT_THAT(text, ContainsRegex("resume: 0"));
  EXPECT_THAT(text, ContainsRegex("does     [A-Z]+.*\nlimit .*\nmission  [A-Z_]+: .*\noffboard: 0"));
  EXPECT_THAT(text, ContainsRegex("mission  not heard: no planner on this bus\nonboard: 0"));
  EXPECT_THAT(text, HasSubstr("done: aborted by the operator: the robot stands\nabort: 0"));
  EXPECT_THAT(text, HasSubstr("followed: 1\nFAILED: aborted by the operator\nstatus: 1"));
}

}  // namespace
}  // namespace priamos
