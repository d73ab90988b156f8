#include "robot/core/safety/authority.hpp"

namespace priamos::robot {
namespace {

const LeaseHolder kPlanner{Driver::kPlanner, 0};
/// Number of values that the counter of e-stop changes has in messages.
constexpr int kEstopChanges = 256;

}  // namespace

void AuthorityConfig::Describe(Archive& a) {
  a.Section("lease", lease, "exactly one driver at a time");
  a.Section("operators", operators, "commands of operators");
}

Lease::Answer Authority::Request(const LeaseHolder& who, Lease::Wish wish, Time now) {
  const LeaseHolder before = lease_.holder();
  const Lease::Answer answer = lease_.Request(who, wish, now);
  NoteChange(before, now);
  return answer;
}

bool Authority::AdmitPath(Time now) {
  if (estop_) return false;
  const bool free = holder().driver == Driver::kNobody;
  if (!free && holder().driver != Driver::kPlanner) return false;
  // Which planner process it was is not known from a path; a planner that asked for the lease keeps it.
  if (free) Request(kPlanner, Lease::Wish::kAcquire, now);
  lease_.Renew(holder(), now);
  return true;
}

CommandVerdict Authority::Admit(const DriveCommand& command, Time now) {
  const CommandVerdict verdict = operator_.Take(command, lease_.IsHeldBy(command.from), now);
  if (verdict == CommandVerdict::kAccepted) lease_.Renew(command.from, now);
  // A hand that rests keeps the lease through an e-stop, and has to rest once more after it.
  if (estop_) operator_.RequireRest();
  return verdict;
}

void Authority::CountEstopChangesFrom(Time start) {
  estop_changes_ = static_cast<int>(ToUtime(start) / 1'000'000 % kEstopChanges);
}

void Authority::PressEstop() {
  SetEstop(true);
  operator_.RequireRest();
}

void Authority::Rearm() {
  SetEstop(false);
}

void Authority::SetEstop(bool estop) {
  if (estop != estop_) estop_changes_ = (estop_changes_ + 1) % kEstopChanges;
  estop_ = estop;
}

void Authority::Tick(Time now, bool path_is_driven) {
  path_is_driven_ = path_is_driven;
  if (path_is_driven && holder().driver == Driver::kPlanner) lease_.Renew(holder(), now);
  const LeaseHolder before = lease_.holder();
  lease_.Expire(now);
  NoteChange(before, now);
}

void Authority::NoteChange(const LeaseHolder& before, Time now) {
  if (lease_.holder() == before) return;
  const Twist2* wish = Wish(now);
  const bool operator_moved = wish && WantsMotion(*wish);
  if (before.driver != Driver::kNobody && (path_is_driven_ || operator_moved)) lease_lost_ = true;
  operator_.BeginAnew();
  operator_.RequireRest();
}

const Twist2* Authority::Wish(Time now) const {
  const DriveCommand* command = estop_ ? nullptr : operator_.Valid(now);
  return command ? &command->twist : nullptr;
}

void Authority::Forget() {
  lease_lost_ = false;
  operator_.Drop();
}

}  // namespace priamos::robot
