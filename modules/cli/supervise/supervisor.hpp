#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/supervise/notify_socket.hpp"
#include "cli/supervise/process_watch.hpp"
#include "common/time.hpp"

namespace priamos::cli {

/// How to start one process.
struct ProcessSpec {
  std::string name;                    ///< unique
  std::string group;                   ///< "onboard", "offboard" or "line": a column of `priamos status`
  std::vector<std::string> arguments;  ///< the first one is the program's path
  std::vector<std::string> after;      ///< names that must be ready before it starts
  bool drives = false;                 ///< moves the base: told to stop before an order starts it again
  bool notifies = true;                ///< sends READY and WATCHDOG; else it is ready as soon as it runs
  std::string folder;                  ///< working directory; empty: this process's
  std::vector<std::string>
      leftovers{};  ///< files that it leaves behind, e.g. links to ttys: removed when it has ended
  WatchPolicy policy;
};

/// State of one process.
struct ProcessReport {
  std::string name, group;
  ProcessState state = ProcessState::kWaiting;
  pid_t pid = 0;  ///< 0 while it does not run
  Time since{};
  int starts = 0;
  bool alarm = false;
  bool drives = false;  ///< as in its spec
  std::string reason;   ///< why it ended last
};

/// Starts processes in the order of their dependencies, keeps their console output, restarts what dies or
/// hangs, and ends all of them. Children die with this process however it ends (PR_SET_PDEATHSIG, SIGKILL),
/// so nothing is ever orphaned. Used by one thread; that thread must be the one that ends last.
class Supervisor {
 public:
  /// Function that is called with a sentence for each change that a person should know of.
  using Announce = std::function<void(const std::string& sentence)>;

  /// Each process writes to `output_folder`/NAME.txt. Throws std::invalid_argument when a name in `after`
  /// does not exist or names depend on each other in a circle.
  Supervisor(std::vector<ProcessSpec> specs, std::string output_folder, Announce announce);
  /// Ends what still runs.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// File descriptor that becomes readable when a process has sent a notification.
  int fd() const { return notify_.fd(); }
  /// Checks all processes once; call it whenever fd() is readable, and every 50 ms.
  void Step(Time now);
  bool AllReady() const;
  std::vector<ProcessReport> Report() const;
  /// File to which a process writes.
  std::string ConsoleFile(const std::string& name) const { return output_folder_ + "/" + name + ".txt"; }
  /// Ends a process, and starts it again at once; false when there is none of that name.
  bool Restart(const std::string& name);
  /// Ends every process named in `specs`, all of them before the first one is started again, as its spec now
  /// says; `forget`: files that are removed in between. Throws std::invalid_argument for an unknown name.
  void Renew(std::vector<ProcessSpec> specs, std::vector<std::string> forget);
  /// Ends processes in the reverse order of their dependencies; SIGKILL for those that do not end.
  void StopAll();
  bool AllStopped() const;

 private:
  struct Child {
    ProcessSpec spec;
    ProcessWatch watch;
    pid_t pid = 0;
    std::optional<ProcessSpec> next = std::nullopt;  ///< how it is started when all to be renewed have ended
  };
  void CheckOrder() const;
  void Listen(Time now);
  void ForgiveOwnSilence(Time now);
  void ForgiveSilence(Time now);
  void LookAtChildren(Time now);
  void Reap(Time now);
  void EndRenewal();
  void Act(Child& child, Time now);
  void Start(Child& child, Time now);
  bool MayStart(const Child& child) const;
  bool MayStop(const Child& child) const;
  const Child& Find(const std::string& name) const;

  std::string output_folder_;
  Announce announce_;
  NotifySocket notify_;
  std::vector<Child> children_;
  std::vector<std::string> forget_;  ///< files that a renewal removes
  Time last_step_{}, next_look_{};
};

}  // namespace priamos::cli
