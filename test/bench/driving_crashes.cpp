#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "test/bench/driving_studies.hpp"

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;

constexpr double kUsefulWithin_ms = 3000;
/// The hand pushes on for so long, then it is off the stick.
constexpr Duration kHandOn{500'000};
/// After that no wheel command but zero: the bound of the stops.
constexpr Duration kLastMotion{300'000};
constexpr Duration kStall{600'000};  ///< shorter than any watchdog
constexpr double kStands_m_s = 0.02;

enum class Fault { kKilled, kHung, kStalled };

const char* Text(Fault fault) {
  return fault == Fault::kKilled ? "kill -9" : fault == Fault::kHung ? "SIGSTOP" : "SIGSTOP 0.6 s";
}

struct Outcome {
  Sample stands, useful;
  int never_useful = 0, moved_after = 0, no_drive = 0;
};

class CrashStudy {
 public:
  explicit CrashStudy(const RigOptions& options) : rig_(options) { rig_.Start(); }
  const DrivingRig& rig() const { return rig_; }

  void Episode(const std::string& name, Fault fault, Outcome& outcome) {
    if (!Drives()) {
      ++outcome.no_drive;
      fmt::print(stderr, "{} {}: no episode, the base does not drive\n", name, Text(fault));
      return;
    }
    rig_.Wait(rig_.rng.Uniform(0, 0.1));
    rig_.Forget();
    const Time when = rig_.Now();
    const int starts = rig_.Starts(name);
    kill(rig_.Pid(name), fault == Fault::kKilled ? SIGKILL : SIGSTOP);
    bool hand_is_on = true, stalled = fault == Fault::kStalled;
    Time stands{}, useful{};
    rig_.Until(
        [&] {
          const Time now = rig_.Now();
          if (hand_is_on && now - when > kHandOn) rig_.LetGo(), hand_is_on = false;
          if (stalled && now - when > kStall) kill(rig_.Pid(name), SIGCONT), stalled = false;
          const auto& t = rig_.truth;
          if (stands == Time{} && t.at > when && std::hypot(t.message.vx_m_s, t.message.vy_m_s) < kStands_m_s)
            stands = now;
          const bool again = fault == Fault::kStalled ? now - when > kStall
                                                      : rig_.Starts(name) > starts && rig_.IsReady(name);
          if (!again) begin_ = now;
          if (again && useful == Time{}) Tap(now);
          if (useful == Time{} && again && Works(name, begin_)) useful = now;
          return useful != Time{} && stands != Time{} && now - when > std::chrono::seconds(2);
        },
        std::chrono::seconds(12));
    if (stands != Time{}) outcome.stands.Add(stands - when);
    if (useful != Time{}) outcome.useful.Add(useful - when);
    outcome.never_useful += useful == Time{};
    outcome.moved_after += std::any_of(rig_.wheels.begin(), rig_.wheels.end(), [&](const auto& w) {
      return w.at > when + kHandOn + kLastMotion && !DrivingRig::IsZero(w.message);
    });
    fmt::print(stderr, "{} {}: stands after {:.2f} s, useful after {:.2f} s, {}\n", name, Text(fault),
               stands == Time{} ? NAN : Seconds(stands - when),
               useful == Time{} ? NAN : Seconds(useful - when), rig_.Reason(name));
    if (name == "offboard-teleop" && fault != Fault::kStalled) rig_.ForgetRange();
  }

 private:
  bool Drives() {
    for (int attempt = 0; attempt < 3; ++attempt) {
      if (rig_.onboard_status.message.estop) rig_.Rearm();
      if (rig_.Grip() && rig_.DriveAtFullSpeed()) return true;
      rig_.ForgetRange();
    }
    return false;
  }

  /// A finger on the dead-man and off again: that teleop hears it shows on the operator's bus.
  void Tap(Time now) {
    if (now - when_tapped_ < milliseconds(150)) return;
    when_tapped_ = now;
    rig_.hand.buttons ^= DrivingRig::kDeadMan;
  }
  bool HeardTheTap(Time begin) const {
    const auto newer = [&](const auto& seen) { return FromUtime(seen.message.utime) > begin; };
    return std::any_of(rig_.lease_requests.begin(), rig_.lease_requests.end(), newer) ||
           std::any_of(rig_.offboard_commands.begin(), rig_.offboard_commands.end(), newer);
  }
  bool HealthyAgain(const std::string& process, Time begin) const {
    return std::any_of(rig_.healths.begin(), rig_.healths.end(), [&](const auto& h) {
      return h.at > begin && h.message.process == process && h.message.state == health_t::OK;
    });
  }

  /// Does its own job again, with something that was made after `begin`.
  bool Works(const std::string& name, Time begin) const {
    const auto newer = [&](const auto& seen) {
      return seen.at > begin && FromUtime(seen.message.utime) > begin;
    };
    if (name == "onboard-world") return newer(rig_.wheel_state) && newer(rig_.truth);
    if (name == "onboard-robot") return newer(rig_.onboard_status);
    if (name == "onboard-head") return HealthyAgain("head", begin);
    if (name == "offboard-planner") return newer(rig_.mission);
    if (name == "offboard-teleop" || name == "spacenavd") return HeardTheTap(begin);
    return newer(rig_.offboard_status);  // a radio or the line: something has come across
  }

  DrivingRig rig_;
  Time begin_{}, when_tapped_{};
};

}  // namespace

int StudyCrashes(const RigOptions& base, int rounds) {
  RigOptions options = base;
  options.own_line = false;
  options.modules = {"world", "robot", "head", "radio", "planner", "teleop"};
  CrashStudy study(options);
  std::map<std::string, std::map<Fault, Outcome>> outcomes;
  // In turn, so that each has run for a while before it is its turn again.
  for (int i = 0; i < rounds; ++i)
    for (const Fault fault : {Fault::kKilled, Fault::kHung, Fault::kStalled})
      for (const std::string& name : study.rig().Names()) study.Episode(name, fault, outcomes[name][fault]);
  fmt::print("\nCrashes and hangs at full speed; the hand pushes on for 0.5 s [ms]\n");
  fmt::print("  {:<18} {:<14} {:>4} {:>10} {:>8}   {:>10} {:>8} {:>8} {:>12} {:>11}\n", "process", "", "n",
             "stands p50", "most", "useful p50", "most", "never", "moved after", "no episode");
  int broken = 0;
  for (const auto& [name, by_fault] : outcomes) {
    for (const auto& [fault, o] : by_fault) {
      const bool held = o.never_useful == 0 && o.moved_after == 0 && o.no_drive == 0 &&
                        o.useful.Largest() <= kUsefulWithin_ms && o.stands.size() == o.useful.size();
      broken += !held;
      fmt::print("  {:<18} {:<14} {:>4} {:>10.0f} {:>8.0f}   {:>10.0f} {:>8.0f} {:>8} {:>12} {:>11}  {}\n",
                 name, Text(fault), o.useful.size(), o.stands.Percentile(50), o.stands.Largest(),
                 o.useful.Percentile(50), o.useful.Largest(), o.never_useful, o.moved_after, o.no_drive,
                 held ? "held" : "BROKEN");
    }
  }
  return broken;
}

}  // namespace priamos::bench
