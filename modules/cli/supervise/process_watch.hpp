#pragma once

#include <optional>
#include <string>

#include "common/time.hpp"

namespace priamos::cli {

/// When one supervised process is given up, and when it is started again.
struct WatchPolicy {
  Duration ready_within = std::chrono::seconds(10);  ///< READY must come so soon after the start
  Duration watchdog =
      std::chrono::milliseconds(1000);  ///< longest silence of one that is ready; 0: none expected
  int starved = 4;  ///< while it waits for a processor, these two may last so many times longer
  Duration stopped = std::chrono::milliseconds(200);  ///< one that was stopped (SIGSTOP) for so long hangs
  Duration stop_within = std::chrono::seconds(2);     ///< after SIGTERM
  Duration first_back_off = std::chrono::seconds(1);  ///< doubled with every failure in a row
  Duration longest_back_off = std::chrono::seconds(30);
  Duration stable_after = std::chrono::seconds(30);  ///< ready for so long: the failures before are forgotten
  int alarm_after = 3;                               ///< failures in a row
};

/// Where in its life a supervised process is; kBackOff: it ended, and waits to be started again.
enum class ProcessState { kWaiting, kStarting, kReady, kBackOff, kStopping, kStopped };
const char* Text(ProcessState state);

/// The life of one supervised process as a state machine with time as argument: waits for what it depends on,
/// must send READY in time and WATCHDOG ever after, is killed when it hangs or stands stopped, and is started
/// again after 1, 2, 4 ... 30 s. Three failures in a row raise an alarm, which a stable run clears. Time in
/// which it would have run and got no processor is, up to a limit, no silence: that is the machine's fault.
class ProcessWatch {
 public:
  /// What the caller does with the process now: SIGTERM for kTerminate, SIGKILL for kKill.
  enum class Action { kNone, kStart, kTerminate, kKill };

  explicit ProcessWatch(const WatchPolicy& policy) : policy_(policy) {}

  /// What to do with the process now. After kStart the caller reports Started or, when that failed, Exited.
  /// `may_stop`: nothing that depends on it runs any more.
  Action Step(bool may_start, bool may_stop, Time now);
  void Started(Time now);
  void SaidReady(Time now);
  void SaidAlive(Time now);
  /// Whether the process is stopped by a signal, as the kernel reports it.
  void SeenStopped(bool stopped, Time now);
  /// For how long the process has waited for a processor, since it was started.
  void SeenWaiting(Duration waited) { waited_ = waited; }
  void Exited(const std::string& how, Time now);
  /// Orders that the process ends and is not started again.
  void Stop() { stopping_ = true; }
  /// Orders that the process ends and starts again without a pause; it counts as no failure. One that does
  /// not run is started at once. Others that depend on it are left alone.
  void Restart() { restarting_ = true; }

  ProcessState state() const { return state_; }
  bool runs() const;
  bool alarm() const { return failures_ >= policy_.alarm_after; }
  int failures() const { return failures_; }  ///< in a row
  int starts() const { return starts_; }
  Time since() const { return since_; }                  ///< when the state began
  const std::string& reason() const { return reason_; }  ///< why the process ended last; empty before

 private:
  void Enter(ProcessState state, Time now);
  Action WatchRunning(Time now);
  Duration Silence(Time since, Duration limit, Time now) const;
  Action WatchStop(bool may_stop, Time now);
  Action EndForRestart(Time now);
  Action Terminate(Time now);
  Action WatchEnding(Time now);

  WatchPolicy policy_;
  ProcessState state_ = ProcessState::kWaiting;
  Time since_{}, alive_{};
  std::optional<Time> stopped_since_;
  Duration waited_{},
      waited_before_{};  ///< for a processor: until now, and until it said last that it lives, when ready
  bool stopping_ = false, restarting_ = false, killed_ = false;
  int failures_ = 0, starts_ = 0;
  std::string reason_, verdict_;  ///< verdict: why it was killed
};

}  // namespace priamos::cli
