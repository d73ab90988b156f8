#pragma once

#include "common/archive.hpp"
#include "common/time.hpp"
#include "robot/core/safety/lease.hpp"
#include "robot/core/safety/operator_input.hpp"

namespace priamos::robot {

/// Who may drive for how long, and which commands are taken.
struct AuthorityConfig {
  LeaseConfig lease;
  OperatorConfig operators;

  void Describe(Archive& a);
};

/// Who may move the base now: the lease, the operator's newest command, the e-stop.
///
/// A path comes from the planner, which takes a free lease by sending one and keeps it while the path is
/// driven. An operator asks for the lease first. After a lease is granted and after an e-stop the stick must
/// have been at rest once: a command for motion is refused until one to stand has come.
class Authority {
 public:
  explicit Authority(const AuthorityConfig& config) : lease_(config.lease), operator_(config.operators) {}

  Lease::Answer Request(const LeaseHolder& who, Lease::Wish wish, Time now);
  /// Whether the planner's path may be driven.
  bool AdmitPath(Time now);
  CommandVerdict Admit(const DriveCommand& command, Time now);
  /// Sets the e-stop, which stays set until Rearm.
  void PressEstop();
  void Rearm();
  /// Counts the e-stop's changes, 0..255, from a number that depends on the second of `start`: a robot that
  /// starts again must not count from where an order of before stands.
  void CountEstopChangesFrom(Time start);

  /// Advances time to `now`; called once per step, before anything is asked. `path_is_driven` renews the
  /// planner's lease.
  void Tick(Time now, bool path_is_driven);

  const LeaseHolder& holder() const { return lease_.holder(); }
  bool estop() const { return estop_; }
  /// How often the e-stop was set or lifted, modulo 256.
  int estop_changes() const { return estop_changes_; }
  /// The velocity that the operator wishes; nullptr without a command that is still valid, and while
  /// the e-stop is set.
  const Twist2* Wish(Time now) const;
  bool OperatorFellSilent(Time now) const { return operator_.FellSilent(now); }
  /// Whether the lease was taken from the driver in motion; true until Forget.
  bool lease_lost() const { return lease_lost_; }
  /// Drops the operator's command and the note of a lost lease, after a halt.
  void Forget();
  /// No operator moves the base until then.
  void StandUntil(Time until) { operator_.StandUntil(until); }
  bool Stands(Time now) const { return operator_.Stands(now); }
  const OperatorInput& input() const { return operator_; }

 private:
  void NoteChange(const LeaseHolder& before, Time now);
  void SetEstop(bool estop);

  Lease lease_;
  OperatorInput operator_;
  bool estop_ = false;
  int estop_changes_ = 0;
  bool path_is_driven_ = false;
  bool lease_lost_ = false;
};

}  // namespace priamos::robot
