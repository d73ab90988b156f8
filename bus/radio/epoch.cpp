#include "bus/radio/epoch.hpp"

#include <utility>

namespace priamos::bus::radio {

EpochAgreement::EpochAgreement(NonceSource nonces) : nonces_(std::move(nonces)), own_(nonces_()) {}

EpochAgreement::Outcome EpochAgreement::OnHello(const Hello& hello) {
  if (hello.echo != own_) {
    // The other end does not know our number yet. It needs an answer only when it cannot use our frames.
    if (!hello.need) return {};
    if (peer_ != hello.nonce) Pairing(hello.nonce);
    return {.agreed = {}, .reply = true};
  }
  if (peer_ && *peer_ != hello.nonce) {
    // Our number belongs to another number: the other end has forgotten again in between, or a replay.
    Pairing(hello.nonce);
    return {.agreed = {}, .reply = true};
  }
  peer_ = hello.nonce;
  Outcome outcome{.agreed = {}, .reply = !hello.agreed};
  if (!agreed_) outcome.agreed = Pair{own_, hello.nonce};
  agreed_ = true;
  return outcome;
}

Hello EpochAgreement::Compose(bool need) const {
  return {.table_hash = 0,
          .stream = 0,
          .nonce = own_,
          .echo = peer_.value_or(0),
          .need = need,
          .agreed = agreed_};
}

void EpochAgreement::Pairing(std::uint64_t peer) {
  if (peer_) own_ = nonces_();
  peer_ = peer;
  agreed_ = false;
}

}  // namespace priamos::bus::radio
