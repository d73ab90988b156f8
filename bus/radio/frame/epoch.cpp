#include "bus/radio/frame/epoch.hpp"

#include <utility>

namespace priamos::bus::radio {
namespace {

constexpr int kRandomBits = 36;
constexpr std::int64_t kSecondsMask = (1 << (64 - kRandomBits)) - 1;

std::uint64_t SecondOf(std::uint64_t nonce) {
  return nonce >> kRandomBits;
}

}  // namespace

std::uint64_t TimedNonce(std::uint64_t random, Time now) {
  const auto second = static_cast<std::uint64_t>(ToUtime(now) / 1'000'000 & kSecondsMask);
  return second << kRandomBits | random >> (64 - kRandomBits);
}

bool Askers::Add(std::uint64_t nonce) {
  const bool answered = answered_.Has(nonce);
  const auto yields_to = [&](std::uint64_t other) { return answered && !answered_.Has(other); };
  const bool first = !newest_;
  const bool latest = first || SecondOf(nonce) > SecondOf(drawn_last_) ||
                      (SecondOf(nonce) == SecondOf(drawn_last_) && !yields_to(drawn_last_));
  const bool newest = first || !yields_to(*newest_);
  if (latest) drawn_last_ = nonce;
  if (newest) newest_ = nonce;
  return latest || newest;
}

std::uint64_t Askers::Take() {
  const std::uint64_t nonce = by_time_ ? drawn_last_ : newest_.value();
  by_time_ = !by_time_;
  answered_.Add(nonce);
  return nonce;
}

void Askers::Refute() {
  if (!newest_) return;
  for (const std::uint64_t nonce : {*newest_, drawn_last_})
    if (answered_.Has(nonce)) refuted_.Add(nonce);
  Clear();
}

void Askers::Clear() {
  newest_.reset();
  by_time_ = true;
}

EpochAgreement::EpochAgreement(NonceSource nonces) : nonces_(std::move(nonces)), own_(nonces_()) {}

EpochAgreement::Change EpochAgreement::OnHello(const Hello& hello, bool same_table, bool heard) {
  if (!used_ && hello.echo == own_) return Prove(hello, same_table);
  const bool answers = hello.echo == own_ || (agreed_ && hello.echo == agreed_->own);
  // An announcement; one of another table is answered, because only an exchange can prove it. An end that has
  // agreed on nothing repeats its hello in any case: with that number in it, it proves itself also to an end
  // that is kept busy by replays.
  if (!answers && !hello.need && same_table) {
    if (!agreed_) asking_.Add(hello.nonce);
    return {};
  }
  // When its data has come, its hello is an old one, and keeps nobody who asks from his answer.
  if (same_table && agreed_ && agreed_->peer == hello.nonce) {
    const bool reply = !confirmed_ && (hello.need || !hello.agreed);
    owes_last_ = owes_last_ || reply;
    return {.known = true, .reply = reply};
  }
  // The other end has forgotten the epoch, or this is a replay: what was used must not be used again.
  if (heard && asking_.Refuted(hello.nonce)) return {};
  if (!asking_.Add(hello.nonce)) return {};
  DrawIfUsed();
  return {.reply = true};
}

EpochAgreement::Change EpochAgreement::Prove(const Hello& hello, bool same_table) {
  used_ = true;
  if (!same_table) {
    DrawIfUsed();
    asking_.Add(hello.nonce);
    return {.fresh = true, .reply = true};
  }
  agreed_ = Pair{own_, hello.nonce};
  confirmed_ = false;
  owes_last_ = !hello.agreed;
  answered_last_ = true;
  asking_.Clear();
  return {.agreed = agreed_, .fresh = true, .reply = !hello.agreed};
}

void EpochAgreement::DrawIfUsed() {
  if (used_) own_ = nonces_();
  used_ = false;
}

void EpochAgreement::OnData() {
  asking_.Refute();
  confirmed_ = agreed_.has_value();
  owes_last_ = false;
}

/// While the other end may not have agreed yet, who asks, which may be replays without end, gets every second
/// hello at most.
Hello EpochAgreement::Compose(bool need) {
  const bool agreed = agreed_ && (!asking_.any() || (owes_last_ && answered_last_));
  answered_last_ = !agreed;
  const std::uint64_t asking = !agreed && asking_.any() ? asking_.Take() : 0;
  return {.table_hash = 0,
          .stream = 0,
          .nonce = agreed ? agreed_->own : own_,
          .echo = agreed ? agreed_->peer : asking,
          .need = need,
          .agreed = agreed};
}

}  // namespace priamos::bus::radio
