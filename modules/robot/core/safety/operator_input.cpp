#include "robot/core/safety/operator_input.hpp"

#include <chrono>
#include <cmath>

#include "common/robot/sequence_number.hpp"

namespace priamos::robot {
namespace {

// The radio restores times to a few milliseconds; a command from further ahead has a wrong clock.
constexpr std::chrono::milliseconds kAheadAllowed{50};

Time EndOf(const DriveCommand& command) {
  return command.time + command.time_to_live;
}

}  // namespace

bool WantsMotion(const Twist2& twist) {
  // A zero that was packed for the radio comes back with a rounding error.
  constexpr double kZero = 1e-6;
  return std::abs(twist.vx) > kZero || std::abs(twist.vy) > kZero || std::abs(twist.wz) > kZero;
}

void OperatorConfig::Describe(Archive& a) {
  a.Number("max_speed_m_s", max_speed_m_s, {"m/s", 0.05, 1.5, "a command beyond it is refused"});
  a.Number("max_turn_rad_s", max_turn_rad_s, {"rad/s", 0.05, 2, "a command beyond it is refused"});
  a.Number("most_time_to_live_s", most_time_to_live_s,
           {"s", 0.02, 0.25, "a command that claims to live longer is refused"});
  a.Number(
      "rest_after_s", rest_after_s,
      {"s", 0.1, 10, "silent for so long after a command to move ran out: the stick must be let go first"});
}

CommandVerdict OperatorInput::Take(const DriveCommand& command, bool has_lease, Time now) {
  const CommandVerdict verdict = Judge(command, has_lease, now);
  ++counts_[static_cast<std::size_t>(verdict)];
  if (verdict == CommandVerdict::kAccepted) {
    command_ = newest_ = command;
    must_rest_ = false;
  } else {
    newest_refusal_ = verdict;
  }
  return verdict;
}

CommandVerdict OperatorInput::Judge(const DriveCommand& command, bool has_lease, Time now) const {
  const Twist2& t = command.twist;
  // Written so that NaN is refused.
  const bool in_range = std::hypot(t.vx, t.vy) <= config_.max_speed_m_s &&
                        std::abs(t.wz) <= config_.max_turn_rad_s && command.time_to_live > Duration::zero() &&
                        command.time_to_live <= FromSeconds(config_.most_time_to_live_s);
  if (!has_lease) return CommandVerdict::kWithoutLease;
  if (!in_range) return CommandVerdict::kOutOfRange;
  if (now > EndOf(command) || command.time > now + kAheadAllowed) return CommandVerdict::kTooOld;
  const bool same_sender = newest_ && newest_->from == command.from;
  if (same_sender && !IsAfter(command.sequence, newest_->sequence)) return CommandVerdict::kOutOfOrder;
  if (MustRest(now) && WantsMotion(t)) return CommandVerdict::kNotAtRest;
  return CommandVerdict::kAccepted;
}

const DriveCommand* OperatorInput::Valid(Time now) const {
  return command_ && now <= EndOf(*command_) ? &*command_ : nullptr;
}

bool OperatorInput::FellSilent(Time now) const {
  return command_ && now > EndOf(*command_) && WantsMotion(command_->twist);
}

bool OperatorInput::MustRest(Time now) const {
  const bool was_away =
      newest_ && WantsMotion(newest_->twist) && now > EndOf(*newest_) + FromSeconds(config_.rest_after_s);
  return must_rest_ || was_away || Stands(now);
}

int OperatorInput::refused() const {
  int sum = 0;
  for (std::size_t i = 1; i < kCommandVerdicts; ++i) sum += counts_[i];
  return sum;
}

}  // namespace priamos::robot
