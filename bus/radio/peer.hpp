#pragma once

#include <cstdint>

#include "bus/radio/bundle_builder.hpp"
#include "bus/radio/frame_ack.hpp"
#include "bus/radio/handshake.hpp"
#include "bus/radio/listeners.hpp"

namespace priamos::bus::radio {

/// What both ends report to each other besides messages: agreement, frames acknowledged, listeners.
struct Peer {
  Handshake handshake;
  FrameAckSender acks{};  ///< acknowledgements of the other end's frames
  SentFrames sent{};      ///< frames of this end, and their acknowledgements
  Listeners listeners{};

  /// What this end knows of the other's frames when it makes one of its own.
  struct Heard {
    std::uint64_t highest = 0;  ///< highest counter accepted
    Time at{};                  ///< arrival of the last frame accepted
    double loss = 0;            ///< share of frames lost, 0..1
    std::uint64_t floor = 0;    ///< highest counter that counts as used
  };
  /// Which entries a frame carries, to be given back when it is cut off.
  struct Loaded {
    bool frame_ack = false;
    bool listeners = false;
  };
  /// Whether a frame is to be made for the sake of an entry of Load().
  bool Due() const { return acks.Pressing() || listeners.changed(); }
  /// Adds the entries that are due; they count as sent.
  Loaded Load(BundleBuilder& bundle, const Heard& heard, Time now);
  void Return(const Loaded& loaded);
  /// Counters begin anew.
  void OnEpochChanged();
};

}  // namespace priamos::bus::radio
