#include "robot/core/safety/lease.hpp"

namespace priamos::robot {

void LeaseConfig::Describe(Archive& a) {
  a.Number("keep_s", keep_s, {"s", 0.5, 60, "a holder that is silent for this long loses the lease"});
}

Lease::Answer Lease::Request(const LeaseHolder& who, Wish wish, Time now) {
  if (who.driver == Driver::kNobody) return Answer::kRefused;
  const bool mine = IsHeldBy(who);
  if (wish == Wish::kRelease) {
    if (!mine) return Answer::kRefused;
    holder_ = {};
    return Answer::kReleased;
  }
  const bool is_free = holder_.driver == Driver::kNobody;
  const bool may_take = wish == Wish::kTakeOver && who.driver >= holder_.driver;
  if (!mine && !is_free && !may_take) return Answer::kRefused;
  holder_ = who;
  heard_ = now;
  return mine ? Answer::kRenewed : Answer::kGranted;
}

void Lease::Renew(const LeaseHolder& who, Time now) {
  if (IsHeldBy(who)) heard_ = now;
}

void Lease::Expire(Time now) {
  if (holder_.driver != Driver::kNobody && now - heard_ > FromSeconds(config_.keep_s)) holder_ = {};
}

}  // namespace priamos::robot
