#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "private_network.hpp"
#include "test/support/temporary_folder.hpp"

// What the live screens leave in a terminal: nothing. `script` is the terminal.

namespace priamos {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char *kEnter = "\x1b[?1049h", *kLeave = "\x1b[?1049l", *kCursor = "\x1b[?25h",
                     *kWipe = "\r\x1b[K";

std::string FileText(const std::filesystem::path& file) {
  std::ifstream in(file);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

class TerminalTest : public ::testing::Test {
 protected:
  /// What a terminal of 80 x 24 gets from `command`, with a recorded run on the onboard bus.
  std::string Screen(const std::string& command) {
    std::ofstream(folder_ / "inside.sh")
        << "stty rows 24 cols 80\nstty -g > " << (folder_ / "before").string() << "\n"
        << command << "\nstty -g > " << (folder_ / "after").string() << "\n";
    const auto answer = RunInPrivateNetwork(
        "cd " + folder_.path().string() +
            "\nLOG=$SOURCE/logs/recorded/door-onboard.lcmlog\nexport BIN LOG SHELL=/bin/bash\n"
            "$BIN/priamos log play $LOG --loop --bus onboard > /dev/null & player=$!\n"
            "script -qc 'bash inside.sh' typescript > /dev/null < /dev/null\n"
            "kill $player; wait $player\n",
        folder_ / "run.sh", 40);
    screen_ = FileText(folder_ / "typescript");
    return screen_;
  }
  /// The terminal's modes are those that it had before.
  void ExpectModesRestored() {
    ASSERT_NE(FileText(folder_ / "before"), "") << screen_;
    EXPECT_EQ(FileText(folder_ / "after"), FileText(folder_ / "before"));
  }

  TemporaryFolder folder_;
  std::string screen_;
};

TEST_F(TerminalTest, ALiveTableGivesTheScreenBackAtCtrlCAndAtKill) {
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const std::string dut = Screen(std::string("timeout --foreground -s ") + signal +
                                   " 4 $BIN/priamos topic list --watch --bus onboard");
    EXPECT_THAT(dut, HasSubstr(kEnter));
    EXPECT_THAT(dut, HasSubstr("POSE"));
    EXPECT_GT(dut.rfind(kLeave), dut.rfind(kEnter));
    EXPECT_GT(dut.rfind(kCursor), dut.rfind("\x1b[?25l"));
    ExpectModesRestored();
  }
}

TEST_F(TerminalTest, LogPlayWipesItsLine) {
  const std::string dut = Screen("$BIN/priamos log play $LOG --to 3 --bus offboard");
  EXPECT_THAT(dut, HasSubstr("space pause"));
  const auto wiped = dut.rfind(kWipe);
  ASSERT_NE(wiped, std::string::npos);
  EXPECT_THAT(dut.substr(wiped), HasSubstr("events sent"));
  EXPECT_THAT(dut.substr(wiped), Not(HasSubstr("space pause")));
  ExpectModesRestored();
}

TEST_F(TerminalTest, LogPlayThatIsStoppedLeavesNothingBehind) {
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const std::string dut = Screen(std::string("timeout --foreground -s ") + signal +
                                   " 2 $BIN/priamos log play $LOG --loop --bus offboard");
    EXPECT_THAT(dut.substr(std::min(dut.rfind(kWipe), dut.size())), HasSubstr("events sent"));
    ExpectModesRestored();
  }
}

TEST_F(TerminalTest, IntoAFileNothingButTextIsWritten) {
  Screen(
      "$BIN/priamos log play $LOG --to 1 --bus offboard > out.txt 2> err.txt; "
      "timeout --foreground -s INT 2 $BIN/priamos topic list --watch --bus onboard > table.txt; "
      "timeout --foreground -s INT 2 $BIN/priamos where --watch --bus onboard > where.txt");
  EXPECT_EQ(FileText(folder_ / "err.txt"), "");
  EXPECT_THAT(FileText(folder_ / "out.txt"), HasSubstr("events sent"));
  EXPECT_THAT(FileText(folder_ / "table.txt"), HasSubstr("undecodable"));
  EXPECT_THAT(FileText(folder_ / "table.txt"), Not(HasSubstr("\x1b")));
  EXPECT_NE(FileText(folder_ / "where.txt"), "");
  EXPECT_THAT(FileText(folder_ / "where.txt"), Not(HasSubstr("\x1b")));
}

}  // namespace
}  // namespace priamos
