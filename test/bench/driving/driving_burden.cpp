#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>

#include "test/bench/driving/driving_studies.hpp"

namespace priamos::bench {
namespace {

constexpr int kLoops = 4;

/// Programs that want all of the processor and are given what is left.
class BusyLoops {
 public:
  BusyLoops() {
    for (pid_t& pid : pids_)
      if ((pid = fork()) == 0) Spin();
  }
  ~BusyLoops() {
    for (const pid_t pid : pids_) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
  }
  BusyLoops(const BusyLoops&) = delete;
  BusyLoops& operator=(const BusyLoops&) = delete;

 private:
  [[noreturn]] static void Spin() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (nice(19) == -1) _exit(1);
    for (std::atomic<unsigned> i = 0;; ++i) continue;
  }
  pid_t pids_[kLoops]{};
};

}  // namespace

int StudyBurden(const RigOptions& base, int seconds) {
  RigOptions options = base;
  options.own_line = false;
  options.modules = {"world", "robot", "head", "radio", "planner", "teleop"};
  DrivingRig rig(options);
  rig.Start();
  const int starts = rig.AllStarts();
  const BusyLoops loops;
  for (int i = 0; i < seconds; ++i) {
    rig.Wait(1);
    rig.Forget();
  }
  const int again = rig.AllStarts() - starts;
  for (const std::string& name : rig.Names())
    if (!rig.Reason(name).empty()) fmt::print("{}: {}\n", name, rig.Reason(name));
  fmt::print("\n{} busy loops of the lowest priority for {} s: {} processes were started again  {}\n", kLoops,
             seconds, again, again == 0 ? "held" : "BROKEN");
  return again != 0;
}

}  // namespace priamos::bench
