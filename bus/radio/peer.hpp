#pragma once

#include <cstdint>
#include <optional>

#include "bus/radio/bundle_builder.hpp"
#include "bus/radio/channels/listeners.hpp"
#include "bus/radio/frame_ack.hpp"
#include "bus/radio/handshake.hpp"
#include "bus/radio/next_key.hpp"

namespace priamos::bus::radio {

/// What both ends report to each other besides messages: agreement, frames acknowledged, listeners.
struct Peer {
  Handshake handshake;
  FrameAckSender acks{};  ///< acknowledgements of the other end's frames
  SentFrames sent{};      ///< frames of this end, and their acknowledgements
  Listeners listeners{};
  std::optional<NextKey> next_key{};             ///< until it is in use
  std::optional<std::uint32_t> announced_key{};  ///< next key of the other end, while it is not in use

  /// State of reception at the time at which this end makes a frame.
  struct Heard {
    std::uint64_t highest = 0;  ///< highest counter accepted
    Time at{};                  ///< arrival of the last frame accepted
    double loss = 0;            ///< share of frames lost, 0..1
    std::uint64_t floor = 0;    ///< highest counter that the other end must not use any more
  };
  /// Which entries a frame carries, to be given back when it is cut off.
  struct Loaded {
    bool frame_ack = false;
    bool listeners = false;
    bool next_key = false;
  };
  /// Whether an entry of Load() is so urgent that a frame is sent for it alone.
  bool Due() const { return acks.Pressing() || listeners.changed(); }
  /// Adds the entries that are due, or the acknowledgement of frames alone; they count as sent.
  Loaded Load(BundleBuilder& bundle, const Heard& heard, bool ack_only, Time now);
  void Return(const Loaded& loaded);
  /// Notes that counters begin anew.
  void OnEpochChanged();
  /// Takes the other end's announcement of its next key.
  void OnNextKey(const NextKeyEntry& entry, Time now);
  /// Goes on with the agreement under the next key, which is no longer the next one.
  void UseNextKey();
};

}  // namespace priamos::bus::radio
