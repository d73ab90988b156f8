#include "bus/radio/peer.hpp"

#include <utility>

namespace priamos::bus::radio {

Peer::Loaded Peer::Load(BundleBuilder& bundle, const Heard& heard, bool ack_only, Time now) {
  Loaded loaded{.frame_ack = acks.Due(now) || (ack_only && acks.Any()),
                .listeners = !ack_only && listeners.Due(now),
                .next_key = !ack_only && next_key && next_key->Due(now)};
  if (loaded.frame_ack && !bundle.Add(acks.Take(heard.highest, heard.at, heard.loss, now))) {
    acks.Return();
    loaded.frame_ack = false;
  }
  if (handshake.floor_due() && !ack_only && bundle.Add(FloorEntry{heard.floor})) handshake.OnFloorSent();
  if (loaded.listeners) bundle.Add(listeners.Take(now));
  if (loaded.next_key) bundle.Add(next_key->Take(now));
  return loaded;
}

void Peer::Return(const Loaded& loaded) {
  if (loaded.frame_ack) acks.Return();
  if (loaded.listeners) listeners.Return();
  if (loaded.next_key && next_key) next_key->Return();
}

void Peer::OnEpochChanged() {
  handshake.OnEpochChanged();
  acks.OnEpochChanged();
  sent.OnEpochChanged();
}

void Peer::OnNextKey(const NextKeyEntry& entry, Time now) {
  announced_key = entry.check;
  if (next_key) next_key->OnAnnounced(entry, now);
}

void Peer::UseNextKey() {
  next_key->handshake.CountOn(handshake);
  handshake = std::move(next_key->handshake);
  next_key.reset();
  announced_key.reset();
}

}  // namespace priamos::bus::radio
