// bus/python on a bus with our programs: the example of its README, and messages both ways.

#include <gmock/gmock.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

std::string ExampleOfReadme() {
  std::ifstream in(PRIAMOS_SOURCE_DIR "/bus/python/README.md");
  std::string line, script;
  while (std::getline(in, line) && line != "```python") {
  }
  while (std::getline(in, line) && line != "```") script += line + "\n";
  return script;
}

class PythonBus : public testing::Test {
 protected:
  ShellAnswer Run(const std::string& script) const {
    return RunInPrivateNetwork("DIR=" + folder_.path().string() +
                                   "\nexport PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$SOURCE/bus/python\n" +
                                   script,
                               folder_ / "script.sh", 60);
  }
  const TemporaryFolder folder_;
};

TEST_F(PythonBus, TheExampleOfItsReadmeRunsAndIsHeard) {
  std::ofstream(folder_ / "example.py") << ExampleOfReadme();
  const auto answer = Run(R"sh(
    cd $SOURCE
    $BIN/priamos topic echo POSE x_m --count 1 > $DIR/heard.txt & ECHO=$!
    until [ $(grep -cE ' 44..FFEF:' /proc/net/udp) -ge 1 ]; do sleep 0.05; done
    python3 $DIR/example.py; wait $ECHO; echo "heard $(cat $DIR/heard.txt)"
  )sh");
  EXPECT_THAT(answer.text, HasSubstr("LOOK_REQUEST {'utime': "));
  EXPECT_THAT(answer.text, HasSubstr("17 bytes: "));
  EXPECT_THAT(answer.text, testing::ContainsRegex("heard [0-9]"));
}

TEST_F(PythonBus, HearsOurProgramsOnTheRobotsBus) {
  const auto answer = Run(R"sh(
    export PRIAMOS_ROBOT=snake
    python3 -m priamos_bus onboard ESTOP --seconds 20 > $DIR/heard.txt & LISTENER=$!
    until [ $(grep -cE ' 43..FFEF:' /proc/net/udp) -ge 1 ]; do sleep 0.05; done
    $BIN/priamos topic pub ESTOP estop_t '{"utime": 5, "action": 1, "driver": 2}' --bus onboard
    until [ -s $DIR/heard.txt ]; do sleep 0.05; done
    kill $LISTENER; wait $LISTENER; echo "listener $?"; cat $DIR/heard.txt
  )sh");
  EXPECT_THAT(answer.text, HasSubstr("listener 0"));
  EXPECT_THAT(answer.text, HasSubstr(R"({"channel":"ESTOP","message":{"utime":5,"action":1,"driver":2}})"));
}

}  // namespace
}  // namespace priamos
