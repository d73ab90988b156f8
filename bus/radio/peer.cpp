#include "bus/radio/peer.hpp"

namespace priamos::bus::radio {

Peer::Told Peer::Tell(BundleBuilder& bundle, const Heard& heard, Time now) {
  Told told{.frame_ack = acks.Due(now), .listeners = listeners.Due(now)};
  if (told.frame_ack) bundle.Add(acks.Take(heard.highest, heard.at, heard.loss, now));
  if (handshake.floor_due()) bundle.Add(FloorEntry{heard.floor});
  if (told.listeners) bundle.Add(listeners.Take(now));
  return told;
}

void Peer::Return(const Told& told) {
  if (told.frame_ack) acks.Return();
  if (told.listeners) listeners.Return();
}

void Peer::OnEpochChanged() {
  handshake.OnEpochChanged();
  acks.OnEpochChanged();
  sent.OnEpochChanged();
}

}  // namespace priamos::bus::radio
