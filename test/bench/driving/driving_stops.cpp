#include <fmt/format.h>
#include <signal.h>

#include <algorithm>

#include "test/bench/driving/driving_studies.hpp"

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;

constexpr double kZeroWithin_ms = 300;

enum class End { kReleased, kUnplugged, kKilled, kCut };

const char* Text(End end) {
  switch (end) {
    case End::kReleased:
      return "stick released";
    case End::kUnplugged:
      return "mouse unplugged";
    case End::kKilled:
      return "teleop killed";
    case End::kCut:
      return "radio cut";
  }
  return "";
}

struct Outcome {
  Sample to_zero;
  int no_drive = 0;  ///< full speed was not reached: no episode
  int no_zero = 0;
  int moved_after = 0;

  int episodes() const { return static_cast<int>(to_zero.size()) + no_zero; }
};

Time Do(DrivingRig& rig, End end) {
  switch (end) {
    case End::kReleased:
      rig.hand.axis = {};
      break;
    case End::kUnplugged:
      rig.mouse_plugged = false;
      break;
    case End::kKilled:
      kill(rig.Pid("offboard-teleop"), SIGKILL);
      rig.ForgetRange();
      break;
    case End::kCut:
      rig.line()->Cut(true);
  }
  return rig.Now();
}

/// What ended the drive goes on for a while, then it is gone: with the hand off the stick, except that it
/// still pushes when teleop comes back.
void Aftermath(DrivingRig& rig, End end) {
  rig.Wait(end == End::kReleased ? 0.5 : 1.0);
  if (end == End::kKilled) {
    rig.Until([&] { return rig.IsReady("offboard-teleop"); }, milliseconds(40'000));
    rig.Wait(0.7);
  }
  rig.LetGo();
  rig.mouse_plugged = true;
  rig.line()->Cut(false);
  rig.Wait(0.4);
}

/// On a busy machine a command may come too late, and the base stops in between.
bool Drives(DrivingRig& rig) {
  for (int attempt = 0; attempt < 3; ++attempt)
    if (rig.Grip() && rig.DriveAtFullSpeed()) return true;
  return false;
}

void Episode(DrivingRig& rig, End end, Outcome& outcome) {
  rig.Forget();
  if (!Drives(rig)) {
    ++outcome.no_drive;
    return;
  }
  rig.Wait(rig.rng.Uniform(0, 0.1));
  const Time ended = Do(rig, end);
  Time zero{};
  const auto is_zero = [&] {
    for (const auto& w : rig.wheels)
      if (w.at > ended && IsZero(w.message)) return zero = w.at, true;
    return false;
  };
  if (!rig.Until(is_zero, milliseconds(1000))) {
    ++outcome.no_zero;
  } else {
    outcome.to_zero.Add(zero - ended);
  }
  Aftermath(rig, end);
  outcome.moved_after += std::any_of(rig.wheels.begin(), rig.wheels.end(), [&](const auto& w) {
    return w.at > std::max(zero, ended + milliseconds(1000)) && !IsZero(w.message);
  });
  outcome.moved_after +=
      zero != Time{} && std::any_of(rig.wheels.begin(), rig.wheels.end(), [&](const auto& w) {
        return w.at > zero && w.at <= ended + milliseconds(1000) && !IsZero(w.message);
      });
}

}  // namespace

int StudyStops(const RigOptions& base, int episodes) {
  RigOptions options = base;
  options.stable_after = milliseconds(500);  // every kill is the first one
  DrivingRig rig(options);
  rig.Start();
  constexpr End kAll[] = {End::kReleased, End::kUnplugged, End::kCut, End::kKilled};
  Outcome outcomes[4];
  for (int i = 0; i < episodes; ++i)
    for (const End end : kAll) {
      Outcome& outcome = outcomes[static_cast<int>(end)];
      // On a busy machine full speed is not always reached: that says nothing about stops.
      for (int attempt = 0, before = outcome.episodes(); attempt < 3 && outcome.episodes() == before;
           ++attempt)
        Episode(rig, end, outcome);
    }
  fmt::print("\nStops at full speed: until the wheel command is zero onboard [ms]\n");
  fmt::print("  {:<18} {:>5} {:>8} {:>8} {:>8} {:>16} {:>14} {:>12}\n", "", "n", "p50", "p95", "most",
             "within 300 ms", "moved after", "no episode");
  int broken = 0;
  for (const End end : kAll) {
    const Outcome& o = outcomes[static_cast<int>(end)];
    const bool held = o.no_zero == 0 && o.moved_after == 0 && o.episodes() == episodes &&
                      o.to_zero.Largest() <= kZeroWithin_ms;
    broken += !held;
    fmt::print("  {:<18} {:>5} {:>8.1f} {:>8.1f} {:>8.1f} {:>16} {:>14} {:>12}  {}\n", Text(end),
               o.to_zero.size(), o.to_zero.Percentile(50), o.to_zero.Percentile(95), o.to_zero.Largest(),
               fmt::format("{} of {}", o.to_zero.Within(kZeroWithin_ms), episodes), o.moved_after, o.no_drive,
               held ? "held" : "BROKEN");
  }
  return broken;
}

}  // namespace priamos::bench
