#pragma once

#include <cstdint>
#include <optional>

#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/frame/frame.hpp"
#include "bus/radio/handshake.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// The key that a running link is to change to. While both ends still use the current one, an end announces
/// its next key in its data frames; one that has the same key asks for an epoch under it, by hellos under it
/// and beside the data. Who has agreed on that epoch changes to it: nothing but a fresh hello under the next
/// key changes anything, so neither a replayed frame nor the current key in wrong hands does.
class NextKey {
 public:
  /// The key `check` names (see KeyCheck), the frames under it, and the agreement under it.
  NextKey(std::uint32_t check, const FrameKeys& keys, const FrameSealer& sealer, Handshake under_it);

  std::uint32_t check() const { return check_; }
  const FrameKeys& keys() const { return keys_; }
  const FrameSealer& sealer() const { return sealer_; }

  /// Whether the next key is to be announced.
  bool Due(Time now) const { return !announced_at_ || now - *announced_at_ >= kAnnounce; }
  /// The announcement; it counts as sent.
  NextKeyEntry Take(Time now);
  /// Makes the announcement due again, because the frame with it was cut off.
  void Return() { announced_at_.reset(); }
  /// Takes the announcement of the other end.
  void OnAnnounced(const NextKeyEntry& entry, Time now);
  /// Takes a hello under the next key, of an end that has it and may have changed already.
  Handshake::Proof OnHello(const Hello& hello, Time now);
  /// What the agreement under the next key goes by, when this end hears the current one so well.
  Reception ReceptionOf(Reception current, Time now) const;

  Handshake handshake;  ///< under the next key

 private:
  static constexpr Duration kAnnounce{2'000'000};

  std::uint32_t check_;
  FrameKeys keys_;
  FrameSealer sealer_;
  std::optional<Time> announced_at_;
  std::optional<Time> ask_until_;  ///< the other end is known to have the key
};

}  // namespace priamos::bus::radio
