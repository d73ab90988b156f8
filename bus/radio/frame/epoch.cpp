#include "bus/radio/frame/epoch.hpp"

#include <utility>

namespace priamos::bus::radio {

EpochAgreement::EpochAgreement(NonceSource nonces) : nonces_(std::move(nonces)), own_(nonces_()) {}

EpochAgreement::Change EpochAgreement::OnHello(const Hello& hello, bool same_table, bool heard) {
  if (!used_ && hello.echo == own_) return Prove(hello, same_table);
  const bool answers = hello.echo == own_ || (agreed_ && hello.echo == agreed_->own);
  // An announcement; one of another table is answered, because only an exchange can prove it. An end that has
  // agreed on nothing repeats its hello in any case: with that number in it, it proves itself also to an end
  // that is kept busy by replays.
  if (!answers && !hello.need && same_table) {
    if (!agreed_) asking_ = hello.nonce;
    return {};
  }
  // When its data has come, its hello is an old one, and keeps nobody who asks from his answer.
  if (same_table && agreed_ && agreed_->peer == hello.nonce) {
    const bool reply = !confirmed_ && (hello.need || !hello.agreed);
    owes_last_ = owes_last_ || reply;
    return {.known = true, .reply = reply};
  }
  // The other end has forgotten the epoch, or this is a replay: what was used must not be used again.
  if (heard && refuted_.Has(hello.nonce)) return {};
  if (asking_ && !answered_.Has(*asking_) && answered_.Has(hello.nonce)) return {};
  DrawIfUsed();
  asking_ = hello.nonce;
  return {.reply = true};
}

EpochAgreement::Change EpochAgreement::Prove(const Hello& hello, bool same_table) {
  used_ = true;
  if (!same_table) {
    DrawIfUsed();
    asking_ = hello.nonce;
    return {.fresh = true, .reply = true};
  }
  agreed_ = Pair{own_, hello.nonce};
  confirmed_ = false;
  owes_last_ = !hello.agreed;
  answered_last_ = true;
  asking_.reset();
  return {.agreed = agreed_, .fresh = true, .reply = !hello.agreed};
}

void EpochAgreement::DrawIfUsed() {
  if (used_) own_ = nonces_();
  used_ = false;
}

void EpochAgreement::OnData() {
  if (asking_ && answered_.Has(*asking_)) refuted_.Add(*asking_);
  asking_.reset();
  confirmed_ = agreed_.has_value();
  owes_last_ = false;
}

/// While the other end may not have agreed yet, who asks, which may be replays without end, gets every second
/// hello at most.
Hello EpochAgreement::Compose(bool need) {
  const bool agreed = agreed_ && (!asking_ || (owes_last_ && answered_last_));
  answered_last_ = !agreed;
  if (!agreed && asking_) answered_.Add(*asking_);
  return {.table_hash = 0,
          .stream = 0,
          .nonce = agreed ? agreed_->own : own_,
          .echo = agreed ? agreed_->peer : asking_.value_or(0),
          .need = need,
          .agreed = agreed};
}

}  // namespace priamos::bus::radio
