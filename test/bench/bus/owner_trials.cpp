#include "test/bench/bus/owner_trials.hpp"

#include <fmt/format.h>

#include <csignal>

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Side = TwoNetworks::Side;
using Robot = std::unique_ptr<Program>;

constexpr int kRefused = 2, kYielded = 1;
constexpr Duration kLimit{10'000'000};

std::string LastLine(const Program& program) {
  std::string text = program.Console();
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// One robot that has driven the base for a moment; null when it never did.
Robot StartDriving(OwnerRig& rig, OwnerTrial& trial) {
  Robot robot = rig.StartRobot();
  if (!rig.Until([&] { return rig.Drives(*robot); }, kLimit)) {
    trial.trouble = "the first robot never drove: " + LastLine(*robot);
    return nullptr;
  }
  rig.Wait(milliseconds(300));
  rig.Forget();
  return robot;
}

bool Names(const Program& loser, const Program& winner) {
  return loser.Console().find(fmt::format("pid {} on ", winner.pid())) != std::string::npos;
}

/// One of the two has ended, or should have: what is left, and whether it drives on.
void Judge(OwnerRig& rig, Program& winner, Program& loser, int exit_code, OwnerTrial& trial) {
  const Time begin = rig.Now();
  const bool ended = rig.Until([&] { return loser.Ended(); }, kLimit);
  trial.settled = rig.Now() - begin;
  const bool drives = rig.Until([&] { return rig.Drives(winner); }, kLimit);
  trial.watch = rig.watch;
  trial.survivors = !winner.Ended() + !loser.Ended();
  trial.right_one = ended && drives;
  trial.said = ended && loser.exit_code() == exit_code && Names(loser, winner);
  if (!trial.right_one || !trial.said)
    trial.trouble = fmt::format("exit code {}: {}; the other one: {}", loser.exit_code(), LastLine(loser),
                                LastLine(winner));
}

/// A second one is started beside one that drives.
OwnerTrial Beside(OwnerRig& rig, int) {
  OwnerTrial trial;
  const Robot first = StartDriving(rig, trial);
  if (!first) return trial;
  const Robot second = rig.StartRobot();
  Judge(rig, *first, *second, kRefused, trial);
  if (trial.watch.contested) trial.trouble = "the wheels were disturbed";
  return trial;
}

/// Two are started at once: either may stay.
OwnerTrial AtOnce(OwnerRig& rig, int) {
  OwnerTrial trial;
  rig.Forget();
  const Robot one = rig.StartRobot(), other = rig.StartRobot();
  rig.Until([&] { return one->Ended() || other->Ended(); }, kLimit);
  const bool one_lost = one->Ended();
  Program &winner = one_lost ? *other : *one, &loser = one_lost ? *one : *other;
  Judge(rig, winner, loser, loser.exit_code() == kYielded ? kYielded : kRefused, trial);
  return trial;
}

/// Two computers that did not hear each other do again, and both drive: the elder stays. In every other trial
/// it is the one that the board has not heard before.
OwnerTrial Healed(OwnerRig& rig, int number) {
  OwnerTrial trial;
  const bool near_is_elder = number % 2 == 0;
  rig.networks.Cut();
  Robot far, near;
  if (!near_is_elder) {
    far = rig.StartRobot(Side::kRight);
    rig.Until([&] { return rig.Holds(Side::kRight, *far); }, kLimit);
    rig.Wait(seconds(1));
  }
  near = StartDriving(rig, trial);
  if (near_is_elder) far = rig.StartRobot(Side::kRight);
  const bool both = rig.Until([&] { return rig.Commands(Side::kRight, *far); }, kLimit);
  rig.Forget();
  rig.networks.Join();
  if (!near || !both) return trial.trouble = "not both drove", trial;
  if (near_is_elder)
    Judge(rig, *near, *far, kYielded, trial);
  else
    Judge(rig, *far, *near, kYielded, trial);
  return trial;
}

/// One that stood still comes back to find that another took its place.
OwnerTrial Frozen(OwnerRig& rig, int) {
  OwnerTrial trial;
  const Robot first = StartDriving(rig, trial);
  if (!first) return trial;
  first->Signal(SIGSTOP);
  const Robot second = rig.StartRobot();
  rig.Until([&] { return rig.Drives(*second); }, kLimit);
  rig.Wait(seconds(1));
  rig.Forget();
  first->Signal(SIGCONT);
  Judge(rig, *second, *first, kYielded, trial);
  return trial;
}

/// One is killed and started again: it drives as soon as it can.
OwnerTrial Crashed(OwnerRig& rig, int) {
  OwnerTrial trial;
  const Robot first = StartDriving(rig, trial);
  if (!first) return trial;
  rig.Mark();
  first->Signal(SIGKILL);
  const Time begin = rig.Now();
  const Robot second = rig.StartRobot();
  trial.right_one = rig.Until([&] { return rig.Holds(Side::kLeft, *second); }, kLimit);
  trial.settled = rig.Now() - begin;
  trial.said = rig.Until([&] { return rig.Drives(*second); }, kLimit);
  trial.watch = rig.watch;
  trial.survivors = !first->Ended() + !second->Ended();
  if (!trial.said) trial.trouble = LastLine(*second);
  return trial;
}

}  // namespace

const std::vector<OwnerKind>& OwnerKinds() {
  static const std::vector<OwnerKind> kinds{
      {"beside", "a second one is started beside one that drives", Beside, false},
      {"at-once", "two are started at once", AtOnce, false},
      {"healed", "two computers hear each other again, both drive", Healed, true},
      {"frozen", "one that was stopped goes on, another has its place", Frozen, false},
      {"crashed", "one is killed and started again", Crashed, false}};
  return kinds;
}

}  // namespace priamos::bench
