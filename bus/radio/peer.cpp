#include "bus/radio/peer.hpp"

namespace priamos::bus::radio {

Peer::Loaded Peer::Load(BundleBuilder& bundle, const Heard& heard, Time now) {
  Loaded loaded{.frame_ack = acks.Due(now), .listeners = listeners.Due(now)};
  if (loaded.frame_ack) bundle.Add(acks.Take(heard.highest, heard.at, heard.loss, now));
  if (handshake.floor_due()) bundle.Add(FloorEntry{heard.floor});
  if (loaded.listeners) bundle.Add(listeners.Take(now));
  return loaded;
}

void Peer::Return(const Loaded& loaded) {
  if (loaded.frame_ack) acks.Return();
  if (loaded.listeners) listeners.Return();
}

void Peer::OnEpochChanged() {
  handshake.OnEpochChanged();
  acks.OnEpochChanged();
  sent.OnEpochChanged();
}

}  // namespace priamos::bus::radio
