#include "bus/radio/frame/epoch.hpp"

#include <utility>

namespace priamos::bus::radio {

EpochAgreement::EpochAgreement(NonceSource nonces) : nonces_(std::move(nonces)), own_(nonces_()) {}

EpochAgreement::Change EpochAgreement::OnHello(const Hello& hello) {
  const bool known = agreed_ && peer_ == hello.nonce;
  if (hello.echo != own_ && !hello.need) return {};  // an announcement
  if (agreed_ && !known) {
    // The other end has forgotten the epoch, or this is a replay: what was used must not be used again.
    own_ = nonces_();
    agreed_ = false;
  } else if (hello.echo == own_ && !known) {
    peer_ = hello.nonce;
    agreed_ = true;
    return {.agreed = Pair{own_, hello.nonce}, .reply = !hello.agreed};
  }
  peer_ = hello.nonce;
  return {.agreed = {}, .reply = !known || hello.need || !hello.agreed};
}

Hello EpochAgreement::Compose(bool need) const {
  return {.table_hash = 0,
          .stream = 0,
          .nonce = own_,
          .echo = peer_.value_or(0),
          .need = need,
          .agreed = agreed_};
}

}  // namespace priamos::bus::radio
