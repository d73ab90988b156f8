#include "robot/core/safety/failsafe.hpp"

namespace priamos::robot {

void FailsafeConfig::Describe(Archive& a) {
  a.Number("wheels_silent_s", wheels_silent_s, {"s", 0.04, 5, "no credible encoder sample"});
  a.Number("wheels_stuck_s", wheels_stuck_s, {"s", 0.2, 10, "commanded to turn, encoders stand"});
  a.Number("sonar_silent_s", sonar_silent_s, {"s", 0.1, 5, "no cycle of the sonar ring"});
  a.Number("bumper_silent_s", bumper_silent_s, {"s", 0.1, 5, "no message of the bumper"});
  a.Number("bumped_s", bumped_s, {"s", 0.5, 30, "the base stands on after somebody touched it"});
  a.Number("pose_lost_s", pose_lost_s, {"s", 0, 5, "no pose, or one too uncertain to drive by"});
  a.Number("head_silent_s", head_silent_s, {"s", 0.2, 60, "no sign of the head while a fix is needed"});
  a.Number("link_lost_operator_s", link_lost_operator_s, {"s", 0, 5, "radio link down, operator drives"});
  a.Number("link_lost_path_s", link_lost_path_s, {"s", 0, 600, "radio link down, path is driven"});
}

std::array<FailsafeRule, kFailsafeRules> FailsafeRules(const FailsafeConfig& c) {
  using enum Condition;
  using enum FailsafeAction;
  constexpr auto kAnybody = DriveSource::kNone;
  return {{
      {kEstop, kAnybody, kHalt, 0, 0, "e-stop pressed", "re-arming, then a new command"},
      {kTouched, kAnybody, kHalt, 0, 0, "the base touched something", "a new command"},
      {kLeaseLost, kAnybody, kHalt, 0, 0, "the one who drives lost the lease", "a new command by its holder"},
      {kOperatorSilent, DriveSource::kOperator, kHalt, 0, 0, "time-to-live of the drive command ran out",
       "a new command"},
      {kLinkLost, DriveSource::kOperator, kHalt, c.link_lost_operator_s, 0, "radio link down",
       "a new command"},
      {kWheelsStuck, kAnybody, kHalt, c.wheels_stuck_s, 0, "commanded to turn, but encoders stand",
       "a new command"},
      {kWheelsSilent, kAnybody, kHold, c.wheels_silent_s, 0.2, "no credible encoder sample", "itself"},
      {kSonarSilent, kAnybody, kHold, c.sonar_silent_s, 0.3, "no cycle of the sonar ring", "itself"},
      {kBumperSilent, kAnybody, kHold, c.bumper_silent_s, 0.3, "no message of the bumper", "itself"},
      {kBumped, DriveSource::kPath, kHold, 0, c.bumped_s, "somebody touched the standing base", "itself"},
      {kPoseLost, DriveSource::kPath, kHold, c.pose_lost_s, 0.2, "no pose, or one too uncertain", "itself"},
      {kHeadSilent, DriveSource::kPath, kHold, c.head_silent_s, 0.5, "head silent while a fix is needed",
       "itself"},
      {kLinkLost, DriveSource::kPath, kHold, c.link_lost_path_s, 0.5, "radio link down", "itself"},
  }};
}

FailsafeDecision Failsafe::Update(const FailsafeInputs& inputs, Time now) {
  FailsafeDecision decision;
  for (std::size_t i = 0; i < kFailsafeRules; ++i) {
    const FailsafeRule& rule = rules_[i];
    Update(rule, inputs[rule.condition], now, states_[i]);
    const bool concerns = rule.source == DriveSource::kNone || rule.source == inputs.source;
    if (!states_[i].active || !concerns || rule.action <= decision.action) continue;
    decision = {rule.action, rule.condition};
  }
  return decision;
}

void Failsafe::Update(const FailsafeRule& rule, Duration lasting, Time now, RuleState& state) {
  const bool present = lasting > Duration::zero();
  if (present && lasting >= FromSeconds(rule.after_s)) state.active = true;
  if (present || !state.active) {
    state.gone_since.reset();
    return;
  }
  if (!state.gone_since) state.gone_since = now;
  if (now - *state.gone_since >= FromSeconds(rule.clear_s)) state = {};
}

}  // namespace priamos::robot
