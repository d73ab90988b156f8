#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// Who decides whose turn it is.
enum class TurnRule : std::uint8_t {
  kAlternate,  ///< two ends hand the turn to each other
  kPolled,     ///< a robot on a shared channel: it answers a poll with one frame, and is silent otherwise
  kGranted     ///< the station's end for one such robot: it sends one frame when the station grants that
};

/// Settings of a radio that cannot send and receive at once.
struct HalfDuplex {
  Duration turn{};        ///< longest time that an end sends; 0: full duplex, or turns of one frame
  Duration turnaround{};  ///< time after its own last byte in which an end cannot receive
  Duration unheard{};     ///< longest time that an end sends before anything of it is heard: a packet
  TurnRule rule = TurnRule::kAlternate;
  Duration grace{};  ///< a polled robot that could not begin so long after it might keeps silent
  /// Longest answer of a polled robot: it gives one up that would end later than that after the last time at
  /// which it might have begun.
  Duration answer{};
};

/// Turns on a half-duplex radio: which end may send, and until when. An end sends "over" in its last frame;
/// the other one begins when it has received that and the first one can receive again. If "over" is lost, an
/// end takes the turn after a time without bytes, which is longer at the onboard end, so that both do not
/// begin at once. Without a turn length both ends may always send.
///
/// On a channel that several robots share a turn is one frame: see TurnRule.
class TurnTaking {
 public:
  TurnTaking(HalfDuplex mode, bool onboard, Time now)
      : mode_(mode),
        onboard_(onboard),
        mine_(onboard && mode.rule == TurnRule::kAlternate),
        began_(now),
        slot_from_(now),
        heard_(now),
        proven_(now) {}

  bool enabled() const { return shared() || mode_.turn > Duration::zero(); }
  /// Whether several robots share the channel.
  bool shared() const { return mode_.rule != TurnRule::kAlternate; }
  bool MayTalk(Time now) const {
    if (!enabled()) return true;
    // The station takes the turn of a silent robot back: a late beginning would meet it.
    const bool late = mode_.rule == TurnRule::kPolled && now > slot_from_ + mode_.grace;
    return mine_ && now >= began_ && !late;
  }
  /// Whether the turn has lasted long enough to be passed on with nothing to send. A poll is always sent, and
  /// always answered.
  bool MayPass(Time now) const {
    if (shared()) return MayTalk(now) && hands_over_;
    return enabled() && mine_ && now >= began_ + kHold;
  }
  /// Whether a further frame of length `longest` after one that ends at `frame_end` would exceed the turn.
  bool MustEnd(Time frame_end, Duration longest) const {
    if (shared()) return hands_over_;
    return enabled() && frame_end + longest > began_ + mode_.turn;
  }

  /// Notes that what had arrived by `now` was read: what is read next came later. Without it, bytes count as
  /// come when they are read.
  void OnLook(Time now) { looked_ = now; }
  /// Whether the station takes a polled robot's turn back before an answer has left that ends at `frame_end`:
  /// its process, or its machine, stood still meanwhile.
  bool SlotEndsBefore(Time frame_end) const {
    return mode_.rule == TurnRule::kPolled && frame_end > slot_from_ + mode_.grace + mode_.answer;
  }

  /// The station gives its end for one robot the time for one frame, which hands the turn to the robot when
  /// it is a poll.
  void Grant(Time now, bool poll) {
    if (hands_over_ && mode_.rule == TurnRule::kGranted) unanswered_ = answered_ ? 0 : unanswered_ + 1;
    Begin(now);
    hands_over_ = poll;
    answered_ = false;
  }
  /// Takes it back from an end that has nothing to send.
  void Revoke() { mine_ = false; }
  /// Whether a frame may be begun or is being sent, on a shared channel.
  bool mine() const { return mine_; }
  /// Whether the robot has handed the turn back since Grant().
  bool answered() const { return answered_; }
  /// Polls in succession that the robot has not answered.
  int unanswered() const { return unanswered_; }
  /// Time from the last turn but one to the last one.
  Duration period() const { return period_; }

  /// Takes the turn when the other end has been silent for too long; `latency` is that of the line.
  void Step(Time now, Duration latency) {
    if (!enabled() || shared() || mine_) return;
    // What came since the last look may be waiting to be read.
    if (looked_) now = std::min(now, *looked_);
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
    answered_ = true;
    if (!enabled() || mode_.rule == TurnRule::kGranted) return;
    Begin(now + mode_.turnaround);
    // The station counts from when the poll came, not from when this process got round to reading it.
    slot_from_ = (looked_ ? std::min(now, *looked_) : now) + mode_.turnaround;
  }
  /// Notes that a frame has left; on a shared channel that was the turn.
  void OnFrameSent() {
    if (shared()) mine_ = false;
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
    period_ = from - began_;
    mine_ = true;
    began_ = from;
  }

  HalfDuplex mode_;
  bool onboard_;
  bool mine_;
  Time began_;                  ///< beginning of the own turn
  Time slot_from_;              ///< a polled robot's turn began then, or later
  std::optional<Time> looked_;  ///< what had arrived by then was read
  Time heard_;                  ///< last sign that the other end has the turn
  Time proven_;                 ///< last one that cannot be anybody else's
  bool hands_over_ = true;      ///< shared: the frame of this turn ends with "over"
  bool answered_ = true;
  int unanswered_ = 0;
  Duration period_{};
  int missed_ = 0;  ///< turns taken since the last "over": the line may be slower than it seems
};

}  // namespace priamos::bus::radio
