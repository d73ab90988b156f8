#include "bus/radio/peer.hpp"

namespace priamos::bus::radio {

Peer::Loaded Peer::Load(BundleBuilder& bundle, const Heard& heard, bool ack_only, Time now) {
  Loaded loaded{.frame_ack = acks.Due(now) || (ack_only && acks.Any()),
                .listeners = !ack_only && listeners.Due(now)};
  if (loaded.frame_ack) bundle.Add(acks.Take(heard.highest, heard.at, heard.loss, now));
  if (handshake.floor_due() && !ack_only) bundle.Add(FloorEntry{heard.floor});
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
