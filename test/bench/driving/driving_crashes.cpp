#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "test/bench/driving/driving_studies.hpp"

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;

constexpr double kUsefulWithin_ms = 3000;
/// The hand pushes on for so long, then it is off the stick.
constexpr Duration kHandOn{500'000};
/// After that no wheel command but zero: the bound of the stops.
constexpr Duration kLastMotion{300'000};
constexpr Duration kStall{
    600'000};  ///< shorter than any watchdog: what is old by then is still in the queues
/// What a robot that looks 50 times a second, and this process that sees its messages, may be late.
constexpr Duration kLate{50'000};
constexpr Duration kFreeze{3'000'000};
constexpr double kLongestGap_ms = 100;
constexpr double kStands_m_s = 0.02;

enum class Fault { kKilled, kHung, kStalled };

const char* Text(Fault fault) {
  return fault == Fault::kKilled ? "kill -9" : fault == Fault::kHung ? "SIGSTOP" : "SIGSTOP 0.6 s";
}

struct Outcome {
  Sample stands, useful;
  int never_useful = 0, moved_after = 0, no_drive = 0, stale = 0;
  Duration oldest{};

  bool held(double useful_within_ms) const {
    return never_useful == 0 && moved_after == 0 && no_drive == 0 && stale == 0 &&
           useful.Largest() <= useful_within_ms && stands.size() == useful.size();
  }
};

class CrashStudy {
 public:
  explicit CrashStudy(const RigOptions& options) : rig_(options) { rig_.Start(); }
  const DrivingRig& rig() const { return rig_; }

  void Episode(const std::string& name, Fault fault, Outcome& outcome) {
    rig_.Forget();
    if (!Drives()) {
      ++outcome.no_drive;
      fmt::print(stderr, "{} {}: no episode, the base does not drive\n", name, Text(fault));
      return;
    }
    rig_.Wait(rig_.rng.Uniform(0, 0.1));
    Watch watch{name, fault, rig_.Now(), rig_.Starts(name), {}, {}, {}};
    kill(rig_.Pid(name), fault == Fault::kKilled ? SIGKILL : SIGSTOP);
    rig_.Until([&] { return Step(watch); }, std::chrono::seconds(12));
    Judge(watch, outcome);
    if (name == "offboard-teleop" && fault != Fault::kStalled) rig_.ForgetRange();
  }

  /// The supervisor itself stands still for a while: nobody needs it for driving, and nobody is blamed.
  void Freeze(Sample& gaps, Outcome& outcome) {
    rig_.Forget();
    if (!Drives()) {
      ++outcome.no_drive;
      return;
    }
    const Time when = rig_.Now();
    const int starts = rig_.AllStarts();
    rig_.supervisor_frozen = true;
    rig_.Wait(Seconds(kFreeze) / 2);
    rig_.LetGo();
    rig_.Wait(Seconds(kFreeze) / 2);
    rig_.supervisor_frozen = false;
    rig_.Wait(1.5);
    outcome.never_useful += rig_.AllStarts() != starts;
    Duration gap{};
    for (std::size_t i = 1; i < rig_.wheels.size(); ++i)
      if (rig_.wheels[i].at > when) gap = std::max(gap, rig_.wheels[i].at - rig_.wheels[i - 1].at);
    gaps.Add(std::max(gap, rig_.Now() - rig_.wheels.back().at));
    CountStale(outcome);
  }

 private:
  /// One fault and what came of it.
  struct Watch {
    std::string name;
    Fault fault;
    Time when;
    int starts = 0;
    Time again, stands, useful;  ///< again: it runs anew, or goes on
    bool hand_is_on = true;
  };

  /// Returns whether everything has been seen.
  bool Step(Watch& w) {
    const Time now = rig_.Now();
    if (w.hand_is_on && now - w.when > kHandOn) {
      rig_.LetGo();
      w.hand_is_on = false;
    }
    const auto& t = rig_.truth;
    if (w.stands == Time{} && t.at > w.when && std::hypot(t.message.vx_m_s, t.message.vy_m_s) < kStands_m_s)
      w.stands = now;
    if (w.again == Time{}) w.again = RunsAgain(w, now);
    if (w.again != Time{} && w.useful == Time{}) {
      if (w.name == "onboard-head") AskHead(now);
      if (!w.hand_is_on) Tap(now);
      if (Works(w)) w.useful = now;
    }
    return w.useful != Time{} && w.stands != Time{} && now - w.when > std::chrono::seconds(2);
  }

  Time RunsAgain(const Watch& w, Time now) {
    if (w.fault != Fault::kStalled) return rig_.Starts(w.name) > w.starts ? now : Time{};
    if (now - w.when <= kStall) return Time{};
    kill(rig_.Pid(w.name), SIGCONT);
    return now;
  }

  void Judge(const Watch& w, Outcome& outcome) {
    if (w.stands != Time{}) outcome.stands.Add(w.stands - w.when);
    if (w.useful != Time{}) outcome.useful.Add(w.useful - w.when);
    outcome.never_useful += w.useful == Time{};
    const auto moved = std::find_if(rig_.wheels.begin(), rig_.wheels.end(), [&](const auto& seen) {
      return seen.at > w.when + kHandOn + kLastMotion && !IsZero(seen.message);
    });
    if (moved != rig_.wheels.end()) TellMotion(w, *moved);
    outcome.moved_after += moved != rig_.wheels.end();
    const Duration oldest = CountStale(outcome);
    fmt::print(stderr, "{} {}: stands after {:.2f} s, useful after {:.2f} s, oldest command {:.0f} ms, {}\n",
               w.name, Text(w.fault), w.stands == Time{} ? NAN : Seconds(w.stands - w.when),
               w.useful == Time{} ? NAN : Seconds(w.useful - w.when), 1e3 * Seconds(oldest),
               rig_.Reason(w.name));
  }

  void TellMotion(const Watch& w, const Seen<wheel_command_t>& moved) const {
    const auto& s = moved.message.speed_rad_s;
    fmt::print(stderr, "{} {}: moved after {:.2f} s: wheels {:.2f} {:.2f} {:.2f} {:.2f} rad/s\n", w.name,
               Text(w.fault), Seconds(moved.at - w.when), s[0], s[1], s[2], s[3]);
    for (const auto& c : rig_.onboard_commands)
      if (c.at > moved.at - milliseconds(300) && c.at < moved.at + milliseconds(100))
        fmt::print(stderr, "    {:.3f} s: drive {:.2f} {:.2f} {:.2f}\n", Seconds(c.at - w.when),
                   c.message.vx_m_s, c.message.vy_m_s, c.message.wz_rad_s);
  }

  Duration CountStale(Outcome& outcome) {
    const Freshness fresh = MeasureFreshness(rig_.wheels, rig_.onboard_commands, kLate);
    outcome.stale += fresh.stale;
    outcome.oldest = std::max(outcome.oldest, fresh.oldest);
    return fresh.oldest;
  }

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
  /// It turns on request as long as its motors answer.
  void AskHead(Time now) {
    if (now - when_asked_ < milliseconds(60)) return;
    when_asked_ = now;
    rig_.TurnHead();
  }

  /// Does its own job again, with something that was made after it began to run again.
  bool Works(const Watch& w) const {
    const Time begin = w.again;
    const std::string& name = w.name;
    const auto newer = [&](const auto& seen) {
      return seen.at > begin && FromUtime(seen.message.utime) > begin;
    };
    if (name == "onboard-world") return newer(rig_.wheel_state) && newer(rig_.truth);
    if (name == "onboard-robot") return newer(rig_.onboard_status);
    if (name == "onboard-head") return newer(rig_.head_command);
    if (name == "offboard-planner") return newer(rig_.mission);
    if (name == "offboard-teleop" || name == "spacenavd") return HeardTheTap(begin);
    return newer(rig_.offboard_status);  // a radio or the line: something has come across
  }

  DrivingRig rig_;
  Time when_tapped_{}, when_asked_{};
};

RigOptions WithEverything(const RigOptions& base) {
  RigOptions options = base;
  options.own_line = false;
  options.modules = {"world", "robot", "head", "radio", "planner", "teleop"};
  return options;
}

using Outcomes = std::map<std::string, std::map<Fault, Outcome>>;

void PrintHead(const std::string& what) {
  fmt::print("\n{} [ms]\n  {:<18} {:<14} {:>4} {:>10} {:>8}   {:>10} {:>8} {:>8} {:>12} {:>7} {:>9} {:>11}\n",
             what, "process", "", "n", "stands p50", "most", "useful p50", "most", "never", "moved after",
             "stale", "oldest", "no episode");
}

int Print(const Outcomes& outcomes) {
  int broken = 0;
  for (const auto& [name, by_fault] : outcomes) {
    for (const auto& [fault, o] : by_fault) {
      const bool held = o.held(kUsefulWithin_ms);
      broken += !held;
      fmt::print(
          "  {:<18} {:<14} {:>4} {:>10.0f} {:>8.0f}   {:>10.0f} {:>8.0f} {:>8} {:>12} {:>7} {:>9.0f} {:>11}  "
          "{}\n",
          name, Text(fault), o.useful.size(), o.stands.Percentile(50), o.stands.Largest(),
          o.useful.Percentile(50), o.useful.Largest(), o.never_useful, o.moved_after, o.stale,
          1e3 * Seconds(o.oldest), o.no_drive, held ? "held" : "BROKEN");
    }
  }
  return broken;
}

int PrintFreeze(const Sample& gaps, const Outcome& o) {
  const bool held =
      o.never_useful == 0 && o.stale == 0 && o.no_drive == 0 && gaps.Largest() <= kLongestGap_ms;
  fmt::print(
      "\nThe supervisor stands still for {:.0f} s, {} times: longest gap of wheel commands {:.0f} ms, "
      "{} times something was started again, {} stale, {} no episode  {}\n",
      Seconds(kFreeze), gaps.size(), gaps.Largest(), o.never_useful, o.stale, o.no_drive,
      held ? "held" : "BROKEN");
  return !held;
}

}  // namespace

int StudyCrashes(const RigOptions& base, int rounds, const std::string& only) {
  RigOptions options = WithEverything(base);
  if (!only.empty()) options.stable_after = milliseconds(500);  // its turn comes too often
  CrashStudy study(options);
  Outcomes outcomes;
  Outcome frozen;
  Sample gaps;
  // In turn, so that each has run for a while before it is its turn again.
  for (int i = 0; i < rounds; ++i) {
    for (const Fault fault : {Fault::kKilled, Fault::kHung})
      for (const std::string& name : study.rig().Names())
        if (name.find(only) != std::string::npos) study.Episode(name, fault, outcomes[name][fault]);
    if (only.empty()) study.Freeze(gaps, frozen);
  }
  PrintHead("Crashes and hangs at full speed; the hand pushes on for 0.5 s");
  return Print(outcomes) + (only.empty() ? PrintFreeze(gaps, frozen) : 0);
}

int StudyStalls(const RigOptions& base, int rounds) {
  RigOptions options = WithEverything(base);
  options.patient = true;
  CrashStudy study(options);
  Outcomes outcomes;
  for (int i = 0; i < rounds; ++i)
    for (const std::string& name : study.rig().Names())
      study.Episode(name, Fault::kStalled, outcomes[name][Fault::kStalled]);
  PrintHead("Stopped for a moment and let go on, at full speed; the hand pushes on for 0.5 s");
  return Print(outcomes);
}

}  // namespace priamos::bench
