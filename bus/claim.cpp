#include "bus/claim.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace priamos::bus {

Claim::Claim(Claimant self, Time now, Duration ask_for)
    : self_(std::move(self)),
      ask_for_(ask_for),
      begin_(now),
      ask_until_(now + ask_for),
      active_(now),
      say_at_(now) {}

/// Everybody on the bus of one robot belongs to it: two names with one port are rivals, too.
bool Claim::IsRival(const Claimant& other) const {
  return other.robot != self_.robot || other.role == self_.role;
}

Duration Claim::Age(Time now) const {
  return rival_heard_ ? frozen_ : now - begin_;
}

bool Claim::Outranks(const ClaimWord& word, Time now) const {
  return std::tuple(word.holds, word.age, word.who.instance) >
         std::tuple(state_ == State::kHeld, Age(now), self_.instance);
}

bool Claim::Touch(Time now) {
  const bool lapsed = now - active_ > kLapse;
  active_ = now;
  if (rival_heard_ && now - *rival_heard_ > kForget) rival_heard_.reset();
  if (!lapsed) return false;
  begin_ = say_at_ = now;
  ask_until_ = now + ask_for_;
  rival_heard_.reset();
  holder_heard_.reset();
  return true;
}

/// Whether a holder, first heard while this one asks, was heard again kConfirm later.
bool Claim::IsConfirmed(Time now) {
  if (!holder_heard_) holder_heard_ = now;
  ask_until_ = std::max(ask_until_, *holder_heard_ + kAskFor);
  return now - *holder_heard_ >= kConfirm;
}

void Claim::Meet(const ClaimWord& word, Time now) {
  if (!rival_heard_) frozen_ = now - begin_;
  rival_heard_ = now;
  if (Outranks(word, now)) {
    if (state_ == State::kAsking && word.holds && !IsConfirmed(now)) return;
    winner_ = word;
    state_ = state_ == State::kHeld ? State::kYielded : State::kRefused;
    return;
  }
  if (state_ != State::kHeld || reported_loser_ == word.who.instance) return;
  reported_loser_ = word.who.instance;
  loser_ = word;
}

void Claim::Hear(const ClaimWord& word, Time now) {
  const bool over = state_ == State::kRefused || state_ == State::kYielded;
  if (over || word.who.instance == self_.instance || !IsRival(word.who)) return;
  // Who asks is no rival of one who holds, and gets its answer.
  if (word.holds || state_ == State::kAsking) Meet(word, now);
  if (said_) say_at_ = std::min(say_at_, std::max(now, *said_ + kAnswer));
}

std::optional<ClaimWord> Claim::Step(Time now) {
  if (state_ == State::kAsking && now >= ask_until_) {
    state_ = State::kHeld;
    say_at_ = now;
  }
  const bool over = state_ == State::kRefused || state_ == State::kYielded;
  if (over || now < say_at_) return std::nullopt;
  said_ = now;
  say_at_ = now + (state_ == State::kHeld ? kAnnounce : kAskAgain);
  return Word(now);
}

ClaimWord Claim::Word(Time now) const {
  return {self_, state_ == State::kHeld, Age(now)};
}

std::optional<ClaimWord> Claim::TakeLoser() {
  return std::exchange(loser_, std::nullopt);
}

}  // namespace priamos::bus
