#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/safety/lease.hpp"

namespace priamos::robot {

/// One wish of an operator for the velocity of the base.
struct DriveCommand {
  Time time{};
  LeaseHolder from;
  int sequence = 0;  ///< 0..65535, counts up and wraps
  Duration time_to_live{};
  Twist2 twist;  ///< base frame
};

/// Whether a velocity is not zero; it is zero for a stick at rest.
bool WantsMotion(const Twist2& twist);

/// Whether a command was accepted, or why not; kNotAtRest: the stick must be let go first.
enum class CommandVerdict { kAccepted, kWithoutLease, kOutOfOrder, kTooOld, kOutOfRange, kNotAtRest };
inline constexpr std::size_t kCommandVerdicts = 6;

/// Largest values that a command may have; beyond them it is refused.
struct OperatorConfig {
  double max_speed_m_s = 0.8;
  double max_turn_rad_s = 0.8;
  double most_time_to_live_s = 0.25;
  double rest_after_s = 0.3;  ///< who was silent so long while he drove must let go of the stick

  void Describe(Archive& a);
};

/// The newest drive command and whether it may still be obeyed. A command counts until its time-to-live,
/// measured from when the operator gave it, has run out; a command without the lease, out of order, too old,
/// or with values out of range is refused and counted. Values are never clamped: a number that cannot be
/// meant is not to be guessed at. An operator who fell silent while he drove, as behind a radio that was cut,
/// moves nothing again before he let go of the stick: he saw nothing in between.
class OperatorInput {
 public:
  explicit OperatorInput(const OperatorConfig& config) : config_(config) {}

  /// Takes a command and returns the verdict. `has_lease`: whether the sender holds the lease.
  CommandVerdict Take(const DriveCommand& command, bool has_lease, Time now);
  /// Forgets the command being obeyed; its sequence number still counts.
  void Drop() { command_.reset(); }
  /// Forgets the sequence numbers, too: who takes the lease counts as he likes, also under the number of a
  /// session that was there before.
  void BeginAnew() {
    command_.reset();
    newest_.reset();
  }
  /// Refuses motion until a command to stand has come: the stick must have been let go once.
  void RequireRest() { must_rest_ = true; }
  /// Refuses motion until then.
  void StandUntil(Time until) { stands_until_ = until; }
  bool Stands(Time now) const { return stands_until_ && now < *stands_until_; }

  /// The command to obey; nullptr when there is none or it ran out.
  const DriveCommand* Valid(Time now) const;
  /// True when the last command wanted motion and ran out: the operator fell silent while driving. After a
  /// command to stand, silence is the normal end.
  bool FellSilent(Time now) const;
  /// Whether motion is refused until a command to stand has come.
  bool MustRest(Time now) const;

  /// How often each verdict was given.
  const std::array<int, kCommandVerdicts>& counts() const { return counts_; }
  int refused() const;
  /// Why the newest refused command was refused; kAccepted before the first.
  CommandVerdict newest_refusal() const { return newest_refusal_; }

 private:
  CommandVerdict Judge(const DriveCommand& command, bool has_lease, Time now) const;

  OperatorConfig config_;
  std::optional<DriveCommand> command_;
  std::optional<DriveCommand> newest_;  ///< accepted last, for the order
  bool must_rest_ = false;
  std::optional<Time> stands_until_;
  std::array<int, kCommandVerdicts> counts_{};
  CommandVerdict newest_refusal_ = CommandVerdict::kAccepted;
};

}  // namespace priamos::robot
