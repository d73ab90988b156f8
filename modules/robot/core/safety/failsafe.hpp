#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "common/archive.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// Conditions that stop the base. The order is that of precedence among equal actions.
enum class Condition {
  kEstop,
  kTouched,
  kLeaseLost,
  kOperatorSilent,
  kWheelsSilent,
  kWheelsStuck,
  kSonarSilent,
  kPoseLost,
  kHeadSilent,
  kLinkLost,
  kBumperSilent,
  kBumped,
};
inline constexpr std::size_t kConditions = 12;

/// Who moves the base.
enum class DriveSource { kNone, kPath, kOperator };

/// What is done about a condition, in ascending order of precedence.
enum class FailsafeAction {
  kNone,
  kHold,  ///< brake on a ramp, keep the path, go on when the condition has cleared
  kHalt,  ///< wheel speeds 0 at once; path and command are forgotten: only a new one moves the base again
};

/// One line of the table: what is done about a condition.
struct FailsafeRule {
  Condition condition;
  DriveSource source;  ///< kNone: whoever drives
  FailsafeAction action;
  double after_s;  ///< time that the condition must last before the action
  double clear_s;  ///< time that the condition must be absent before the action ends
  std::string_view meaning;
  std::string_view cleared_by;
};

/// Time limits of the conditions. The defaults are those of the table in README.md.
struct FailsafeConfig {
  double wheels_silent_s = 0.2;
  double wheels_stuck_s = 1.0;
  double sonar_silent_s = 0.5;
  double bumper_silent_s = 0.5;
  double bumped_s = 1.5;  ///< so long the base stands on after what came to it has left: until it is told
  double pose_lost_s = 0.2;
  double head_silent_s = 3.0;
  double link_lost_operator_s = 0.25;
  double link_lost_path_s = 10;

  void Describe(Archive& a);
};

inline constexpr std::size_t kFailsafeRules = 13;
/// All rules, highest precedence first.
std::array<FailsafeRule, kFailsafeRules> FailsafeRules(const FailsafeConfig& config);

/// The conditions present, for how long, and the source of motion.
struct FailsafeInputs {
  /// Time that each condition has lasted; 0 when it is not present, Duration::max() when it has always
  /// been.
  std::array<Duration, kConditions> lasting{};
  DriveSource source = DriveSource::kNone;

  Duration& operator[](Condition condition) { return lasting[static_cast<std::size_t>(condition)]; }
  Duration operator[](Condition condition) const { return lasting[static_cast<std::size_t>(condition)]; }
};

/// What to do, and the condition that asks for it.
struct FailsafeDecision {
  FailsafeAction action = FailsafeAction::kNone;
  std::optional<Condition> cause;  ///< condition that asks for the action
};

/// Decides what is done about everything that is wrong at once: the strongest action wins. A condition that
/// comes and goes does not grant a new period: it must be gone for the clearing time before its action is
/// lifted. What kHalt has stopped stays stopped; that is the caller's memory, because only a new command
/// moves the base again.
class Failsafe {
 public:
  explicit Failsafe(const FailsafeConfig& config) : rules_(FailsafeRules(config)) {}

  FailsafeDecision Update(const FailsafeInputs& inputs, Time now);

 private:
  struct RuleState {
    bool active = false;
    std::optional<Time> gone_since;
  };
  static void Update(const FailsafeRule& rule, Duration lasting, Time now, RuleState& state);

  std::array<FailsafeRule, kFailsafeRules> rules_;
  std::array<RuleState, kFailsafeRules> states_{};
};

}  // namespace priamos::robot
