#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "test/bench/driving/driving_studies.hpp"

namespace priamos::bench {
namespace {

using std::chrono::milliseconds;

constexpr double kBeyondLine_ms = 60;
/// [rad/s] of the wheels, far above what a turning base with uneven rounding shows.
constexpr double kDrivesOn = 0.05;
constexpr double kPush = 0.6;

struct Stages {
  Sample whole, line, beyond, teleop, radio, robot;
};

struct Answer {
  Time teleop{}, radio{}, wheels{};
};

/// When the new wish was seen on either bus and at the wheels, all of them after `pushed`.
bool Complete(DrivingRig& rig, Time pushed, Answer& answer) {
  const auto first = [&](const auto& all, const auto& wants) {
    for (const auto& seen : all)
      if (seen.at >= pushed && wants(seen.message)) return seen.at;
    return Time{};
  };
  const auto forward = [](const drive_command_t& c) { return std::abs(c.vx_m_s) > 0.02; };
  answer.teleop = first(rig.offboard_commands, forward);
  answer.radio = first(rig.onboard_commands, forward);
  answer.wheels = first(
      rig.wheels, [](const wheel_command_t& c) { return std::abs(DrivingRig::Forward(c)) > kDrivesOn; });
  return answer.wheels != Time{};
}

/// One push forward or back, out of `turn`; adds to `stages`. False when the wheels never answered.
bool Push(DrivingRig& rig, double turn, Stages& stages) {
  rig.hand.axis = {};
  rig.hand.axis[5] = turn;
  rig.Wait(rig.rng.Uniform(0.35, 0.6));
  rig.Forget();
  const Time before = rig.mouse_spoke();
  rig.hand.axis[0] = rig.rng.Chance(0.5) ? kPush : -kPush;
  if (!rig.Until([&] { return rig.mouse_spoke() != before; }, milliseconds(300))) return false;
  const Time pushed = rig.mouse_spoke();
  Answer answer;
  if (!rig.Until([&] { return Complete(rig, pushed, answer); }, milliseconds(1500))) return false;
  rig.Wait(0.01);
  const Duration line = rig.line()->WireTime(rig.line()->DownFrameBefore(answer.radio));
  stages.whole.Add(answer.wheels - pushed);
  stages.line.Add(line);
  stages.beyond.Add(answer.wheels - pushed - line);
  stages.teleop.Add(answer.teleop - pushed);
  stages.radio.Add(answer.radio - answer.teleop - line);
  stages.robot.Add(answer.wheels - answer.radio);
  return true;
}

void Print(const char* what, const Stages& s) {
  const auto row = [&](const char* name, const Sample& sample) {
    fmt::print("  {:<12} {:<44} {:>5} {:>8.1f} {:>8.1f} {:>8.1f}\n", what, name, sample.size(),
               sample.Percentile(50), sample.Percentile(95), sample.Largest());
  };
  row("stick to wheel command", s.whole);
  row("the line itself (bytes of the frame)", s.line);
  row("beyond the line", s.beyond);
  row("  spacenavd and teleop", s.teleop);
  row("  radio beyond the line", s.radio);
  row("  robot", s.robot);
}

}  // namespace

int StudyLatency(const RigOptions& options, int samples) {
  DrivingRig rig(options);
  rig.Start();
  Stages from_rest, on_the_way;
  int silent = 0;
  for (int i = 0; i < samples; ++i) {
    if (i % 20 == 0 && !rig.Grip()) throw std::runtime_error("the operator does not get the lease");
    const bool rest = i % 2 == 0;
    const double turn = rest ? 0 : (i % 4 == 1 ? kPush : -kPush);
    silent += !Push(rig, turn, rest ? from_rest : on_the_way);
  }
  fmt::print("\nFrom the stick to the wheels through 9600 baud [ms]\n");
  fmt::print("  {:<12} {:<44} {:>5} {:>8} {:>8} {:>8}\n", "", "", "n", "p50", "p95", "most");
  Print("from rest", from_rest);
  Print("on the way", on_the_way);
  const bool held = silent == 0 && from_rest.beyond.Percentile(95) <= kBeyondLine_ms &&
                    on_the_way.beyond.Percentile(95) <= kBeyondLine_ms;
  fmt::print("  asked: p95 beyond the line at most {:.0f} ms: {}; never answered: {}\n", kBeyondLine_ms,
             held ? "held" : "BROKEN", silent);
  return held ? 0 : 1;
}

}  // namespace priamos::bench
