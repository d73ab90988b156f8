#include "cli/supervise/process_stat.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace priamos::cli {
namespace {

/// A child that does nothing but turn.
class ProcessStatTest : public testing::Test {
 protected:
  ProcessStatTest() : pid_(fork()) {
    while (pid_ == 0) getppid();
  }
  ~ProcessStatTest() override {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  pid_t pid_;
};

TEST_F(ProcessStatTest, ASignalStopsAProcessAndAnotherLetsItGoOn) {
  EXPECT_FALSE(IsStopped(pid_));
  kill(pid_, SIGSTOP);
  waitpid(pid_, nullptr, WUNTRACED);
  EXPECT_TRUE(IsStopped(pid_));
  kill(pid_, SIGCONT);
  waitpid(pid_, nullptr, WCONTINUED);
  EXPECT_FALSE(IsStopped(pid_));
}

TEST_F(ProcessStatTest, TimeThatAProcessWaitsForAProcessorOnlyGrows) {
  const Duration before = WaitedForProcessor(pid_);
  usleep(20'000);
  EXPECT_GE(before, Duration::zero());
  EXPECT_GE(WaitedForProcessor(pid_), before);
}

TEST(ProcessStat, AProcessThatIsGoneIsNotStoppedAndWaitsForNothing) {
  const pid_t pid = fork();
  if (pid == 0) _exit(0);
  waitpid(pid, nullptr, 0);
  EXPECT_FALSE(IsStopped(pid));
  EXPECT_EQ(WaitedForProcessor(pid), Duration::zero());
}

}  // namespace
}  // namespace priamos::cli
