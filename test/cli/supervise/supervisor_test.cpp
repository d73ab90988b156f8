// The supervisor with real processes: shells that behave well, die, hang, or stay deaf.

#include "cli/supervise/supervisor.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "bus/clocks/clock.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

/// What every script begins with: say(b"READY=1") as sd_notify does it.
const std::string kNotify =
    "import os,socket,sys,time\n"
    "a=os.environ['NOTIFY_SOCKET']; a='\\0'+a[1:]\n"
    "s=socket.socket(socket.AF_UNIX,socket.SOCK_DGRAM); s.connect(a)\n"
    "def say(t): s.send(t)\n";

class SupervisorTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/supervisor-XXXXXX";
    folder_ = mkdtemp(name);
  }
  void TearDown() override { fs::remove_all(folder_); }

  ProcessSpec Python(const std::string& name, const std::string& script,
                     std::vector<std::string> after = {}) {
    ProcessSpec spec;
    spec.name = name;
    spec.after = std::move(after);
    spec.arguments = {"/usr/bin/python3", "-c", kNotify + script};
    spec.policy.watchdog = milliseconds(600);
    spec.policy.first_back_off = milliseconds(50);
    spec.policy.stop_within = milliseconds(300);
    return spec;
  }
  const std::string kWell = "say(b'READY=1')\nwhile True:\n  say(b'WATCHDOG=1'); time.sleep(0.1)\n";

  /// Steps until `done`, at most `most`. Returns whether it came.
  bool Until(Supervisor& dut, const std::function<bool()>& done, milliseconds most = milliseconds(8000)) {
    for (milliseconds t{}; t < most; t += milliseconds(10)) {
      dut.Step(clock_.Now());
      if (done()) return true;
      std::this_thread::sleep_for(milliseconds(10));
    }
    return false;
  }
  Supervisor::Announce Told() {
    return [this](const std::string& text) { told_.push_back(text); };
  }
  std::string Console(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ + "/" + name + ".txt").rdbuf();
    return text.str();
  }

  bus::MonotonicClock clock_;
  std::string folder_;
  std::vector<std::string> told_;
};

TEST_F(SupervisorTest, StartsInTheOrderOfDependenciesAndStopsInTheReverse) {
  {
    Supervisor dut({Python("second", "time.sleep(0.05)\n" + kWell, {"first"}),
                    Python("first", "time.sleep(0.2)\n" + kWell)},
                   folder_, Told());
    dut.Step(clock_.Now());
    EXPECT_EQ(dut.Report()[0].state, ProcessState::kWaiting);
    ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
    EXPECT_THAT(told_, testing::ElementsAre("first is ready", "second is ready"));
    dut.StopAll();
    dut.Step(clock_.Now());
    EXPECT_EQ(dut.Report()[0].state, ProcessState::kStopping);
    EXPECT_EQ(dut.Report()[1].state, ProcessState::kReady);
    EXPECT_TRUE(Until(dut, [&] { return dut.AllStopped(); }));
  }
}

TEST_F(SupervisorTest, StartsAgainWhatWasKilledAndKeepsItsConsole) {
  Supervisor dut({Python("a", "print('hello', flush=True)\n" + kWell)}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  const pid_t first = dut.Report()[0].pid;
  kill(first, SIGKILL);
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady() && dut.Report()[0].pid != first; }));
  EXPECT_EQ(dut.Report()[0].starts, 2);
  EXPECT_THAT(dut.Report()[0].reason, HasSubstr("killed by signal 9"));
  EXPECT_EQ(Console("a"), "--- start 1\nhello\n--- start 2\nhello\n");
}

TEST_F(SupervisorTest, RemovesWhatOneThatWasKilledLeftBehindBeforeItStartsAgain) {
  const std::string link = folder_ + "/link";
  ProcessSpec spec = Python("a", "os.symlink('/dev/null', '" + link + "')\n" + kWell);
  spec.leftovers = {link};
  spec.policy.first_back_off = milliseconds(300);
  Supervisor dut({spec}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  kill(dut.Report()[0].pid, SIGKILL);
  ASSERT_TRUE(Until(dut, [&] { return !dut.AllReady(); }));
  EXPECT_FALSE(fs::is_symlink(link));
  EXPECT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
}

TEST_F(SupervisorTest, KillsAndStartsAgainWhatHangs) {
  Supervisor dut({Python("a", "say(b'READY=1')\ntime.sleep(60)\n")}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  const pid_t first = dut.Report()[0].pid;
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady() && dut.Report()[0].pid != first; }));
  EXPECT_THAT(dut.Report()[0].reason, HasSubstr("hung: silent"));
}

TEST_F(SupervisorTest, KillsAndStartsAgainWhatIsStopped) {
  Supervisor dut({Python("a", kWell)}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  const pid_t first = dut.Report()[0].pid;
  kill(first, SIGSTOP);
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady() && dut.Report()[0].pid != first; }));
  EXPECT_THAT(dut.Report()[0].reason, HasSubstr("hung: stopped"));
}

TEST_F(SupervisorTest, OneThatSaysNothingHangsWhenItIsStopped) {
  ProcessSpec mute = Python("a", "time.sleep(60)\n");
  mute.notifies = false;
  Supervisor dut({mute}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  const pid_t first = dut.Report()[0].pid;
  EXPECT_FALSE(Until(
      dut, [&] { return dut.Report()[0].pid != first; }, milliseconds(900)));
  kill(first, SIGSTOP);
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady() && dut.Report()[0].pid != first; }));
  EXPECT_THAT(dut.Report()[0].reason, HasSubstr("hung"));
}

TEST_F(SupervisorTest, TellsWhyAndRaisesTheAlarm) {
  Supervisor dut({Python("a", "sys.stderr.write('no such port\\n'); sys.exit(2)\n")}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.Report()[0].alarm; }));
  EXPECT_THAT(told_, Contains("a ended: exit code 2: no such port"));
  EXPECT_THAT(told_.back(), HasSubstr("ALARM"));
}

TEST_F(SupervisorTest, AProgramThatDoesNotExistIsSaidSo) {
  ProcessSpec spec = Python("a", "");
  spec.arguments = {"/no/such/program"};
  Supervisor dut({spec}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return !told_.empty(); }));
  EXPECT_THAT(told_[0], HasSubstr("the program cannot be started"));
}

TEST_F(SupervisorTest, OneThatIsDeafIsKilledInTheEnd) {
  pid_t pid = 0;
  {
    Supervisor dut({Python("a", "import signal\nsignal.signal(signal.SIGTERM,signal.SIG_IGN)\n" + kWell)},
                   folder_, Told());
    ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
    pid = dut.Report()[0].pid;
  }
  EXPECT_NE(kill(pid, 0), 0);
}

TEST_F(SupervisorTest, ReadyFromAnotherProcessDoesNotCount) {
  Supervisor dut({Python("a", "time.sleep(60)\n"), Python("b", "say(b'READY=1\\nREADY=1')\n" + kWell)},
                 folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.Report()[1].state == ProcessState::kReady; }));
  EXPECT_EQ(dut.Report()[0].state, ProcessState::kStarting);
}

/// The supervisor itself stood still, longer than the watchdog: nobody is to blame for what it did not hear.
TEST_F(SupervisorTest, ForgivesWhatItCouldNotHearItself) {
  const std::string loud = "say(b'READY=1')\nwhile True:\n  say(b'WATCHDOG=1'); time.sleep(0.005)\n";
  Supervisor dut({Python("a", kWell), Python("b", loud)}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  std::this_thread::sleep_for(milliseconds(1500));
  EXPECT_FALSE(Until(
      dut, [&] { return !dut.AllReady(); }, milliseconds(1000)));
  EXPECT_EQ(dut.Report()[0].starts + dut.Report()[1].starts, 2);
}

/// The supervisor itself is killed: its children die with it, also one that is stopped.
TEST_F(SupervisorTest, LeavesNoOrphanWhenItIsKilled) {
  const std::string pids = folder_ + "/pids";
  const pid_t parent = fork();
  if (parent == 0) {
    Supervisor dut({Python("a", kWell), Python("b", kWell)}, folder_, [](const std::string&) {});
    Until(dut, [&] { return dut.AllReady(); });
    kill(dut.Report()[1].pid, SIGSTOP);
    std::ofstream(pids + ".new") << dut.Report()[0].pid << " " << dut.Report()[1].pid;
    fs::rename(pids + ".new", pids);
    for (;;) pause();
  }
  for (int i = 0; i < 800 && !fs::exists(pids); ++i) std::this_thread::sleep_for(milliseconds(10));
  pid_t a = 0, b = 0;
  std::ifstream(pids) >> a >> b;
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  ASSERT_GT(a, 1);
  ASSERT_GT(b, 1);
  // Init reaps them; a zombie answers kill(0) but runs no more.
  const auto runs = [](pid_t pid) {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string text;
    std::getline(stat, text);  // nothing when it ends in this moment
    return !text.empty() && text.substr(text.rfind(')') + 2, 1) != "Z";
  };
  for (int i = 0; i < 200 && (runs(a) || runs(b)); ++i) std::this_thread::sleep_for(milliseconds(10));
  EXPECT_FALSE(runs(a));
  EXPECT_FALSE(runs(b));
}

TEST_F(SupervisorTest, ACircleIsRefused) {
  EXPECT_THROW(Supervisor({Python("a", "", {"b"}), Python("b", "", {"a"})}, folder_, Told()),
               std::invalid_argument);
  EXPECT_THROW(Supervisor({Python("a", "", {"nobody"})}, folder_, Told()), std::invalid_argument);
}

TEST_F(SupervisorTest, StartsOneAgainByOrderAndLeavesTheOthers) {
  Supervisor dut({Python("first", kWell), Python("second", kWell, {"first"})}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  const auto before = dut.Report();
  EXPECT_FALSE(dut.Restart("third"));
  EXPECT_TRUE(dut.Restart("first"));
  ASSERT_TRUE(Until(dut, [&] { return dut.Report()[0].starts == 2 && dut.AllReady(); }));
  const auto after = dut.Report();
  EXPECT_NE(after[0].pid, before[0].pid);
  EXPECT_EQ(after[1].pid, before[1].pid);
  EXPECT_THAT(Console("first"), AllOf(HasSubstr("--- start 1"), HasSubstr("--- start 2")));
}

TEST_F(SupervisorTest, RenewsAllBeforeItStartsAnyAndForgetsFiles) {
  const std::string forgotten = folder_ + "/forgotten";
  // The slow one writes when it ends; the quick one says what it finds when it begins anew.
  const std::string slow = "import signal\ndef end(*a):\n  time.sleep(0.2); open('" + forgotten +
                           "','w'); sys.exit(0)\n"
                           "signal.signal(signal.SIGTERM,end)\n" +
                           kWell;
  const std::string quick = "print('left:', os.path.exists('" + forgotten + "'), flush=True)\n" + kWell;
  Supervisor dut({Python("quick", kWell), Python("slow", slow), Python("other", kWell)}, folder_, Told());
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  const pid_t other = dut.Report()[2].pid;
  EXPECT_THROW(dut.Renew({Python("nobody", kWell)}, {}), std::invalid_argument);
  dut.Renew({Python("quick", quick), Python("slow", kWell)}, {forgotten});
  EXPECT_FALSE(dut.AllReady()) << "from the order on";
  ASSERT_TRUE(Until(dut, [&] { return dut.AllReady(); }));
  EXPECT_EQ(dut.Report()[0].starts, 2);
  EXPECT_EQ(dut.Report()[1].starts, 2);
  EXPECT_EQ(dut.Report()[2].pid, other);
  EXPECT_THAT(Console("quick"), HasSubstr("left: False"));
}

}  // namespace
}  // namespace priamos::cli
