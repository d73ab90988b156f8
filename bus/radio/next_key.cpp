#include "bus/radio/next_key.hpp"

#include <utility>

namespace priamos::bus::radio {
namespace {

/// Some hellos: what is lost is made good after the next announcement.
constexpr Duration kAsk{1'000'000};

}  // namespace

NextKey::NextKey(std::uint32_t check, const FrameKeys& keys, const FrameSealer& sealer, Handshake under_it)
    : handshake(std::move(under_it)), check_(check), keys_(keys), sealer_(sealer) {}

NextKeyEntry NextKey::Take(Time now) {
  announced_at_ = now;
  return {check_};
}

void NextKey::OnAnnounced(const NextKeyEntry& entry, Time now) {
  if (entry.check == check_) ask_until_ = now + kAsk;
}

/// A hello that asks is answered, and the answer is enough. One that does not comes from an end that has
/// changed, and of which this one does not hear any data.
Handshake::Proof NextKey::OnHello(const Hello& hello, Time now) {
  const Handshake::Proof proof = handshake.OnHello(hello);
  if (!proof.fresh && !hello.need) ask_until_ = now + kAsk;
  return proof;
}

/// Without an epoch, and when nothing usable comes, the other end may be one that has changed: hellos go out
/// under both keys.
Reception NextKey::ReceptionOf(Reception current, Time now) const {
  return ask_until_ && now < *ask_until_ ? Reception::kUnusable : current;
}

}  // namespace priamos::bus::radio
