#pragma once

#include <algorithm>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// Settings of a radio that cannot send and receive at once.
struct HalfDuplex {
  Duration turn{};        ///< longest time that an end sends; 0: full duplex
  Duration turnaround{};  ///< time after its own last byte in which an end cannot receive
  Duration unheard{};     ///< longest time that an end sends before anything of it is heard: a packet
};

/// Turns on a half-duplex radio: which end may send, and until when. An end sends "over" in its last frame;
/// the other one begins when it has received that and the first one can receive again. If "over" is lost, an
/// end takes the turn after a time without bytes, which is longer at the onboard end, so that both do not
/// begin at once. Without a turn length both ends may always send.
class TurnTaking {
 public:
  TurnTaking(HalfDuplex mode, bool onboard, Time now)
      : mode_(mode), onboard_(onboard), mine_(onboard), began_(now), heard_(now), proven_(now) {}

  bool enabled() const { return mode_.turn > Duration::zero(); }
  bool MayTalk(Time now) const { return !enabled() || (mine_ && now >= began_); }
  /// Whether the turn has lasted long enough to be passed on with nothing to send.
  bool MayPass(Time now) const { return enabled() && mine_ && now >= began_ + kHold; }
  /// Whether a further frame of length `longest` after one that ends at `frame_end` would exceed the turn.
  bool MustEnd(Time frame_end, Duration longest) const {
    return enabled() && frame_end + longest > began_ + mode_.turn;
  }

  /// Takes the turn when the other end has been silent for too long; `latency` is that of the line.
  void Step(Time now, Duration latency) {
    if (!enabled() || mine_) return;
    const Duration patience = 2 * mode_.turnaround + 2 * latency + kSilence + mode_.unheard;
    const Duration first_byte = mode_.turnaround + 2 * latency + kSilence + mode_.unheard;
    const Duration wait = patience + (onboard_ ? first_byte : Duration::zero());
    if (now < heard_ + (1 + missed_) * wait) return;
    missed_ = std::min(missed_ + 1, kMostMissed);
    Begin(now);
  }
  /// Bytes keep this end silent no longer than a turn can last: nobody knows yet whose they are.
  void OnBytes(Time now) { heard_ = std::max(heard_, std::min(now, proven_ + mode_.turn)); }
  void OnFrame(Time now) { proven_ = heard_ = std::max(heard_, now); }
  void OnOverReceived(Time now) {
    missed_ = 0;
    if (enabled()) Begin(now + mode_.turnaround);
  }
  void OnOverSent(Time frame_end) {
    mine_ = false;
    proven_ = heard_ = std::max(heard_, frame_end);
  }

 private:
  static constexpr Duration kHold{10'000};
  static constexpr int kMostMissed = 9;
  static constexpr Duration kSilence{40'000};
  void Begin(Time from) {
    mine_ = true;
    began_ = from;
  }

  HalfDuplex mode_;
  bool onboard_;
  bool mine_;
  Time began_;      ///< beginning of the own turn
  Time heard_;      ///< last sign that the other end has the turn
  Time proven_;     ///< last one that cannot be anybody else's
  int missed_ = 0;  ///< turns taken since the last "over": the line may be slower than it seems
};

}  // namespace priamos::bus::radio
