#pragma once

#include <optional>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// An urgent event that is not acknowledged is repeated without a pause for so long, and then on half of the
/// line. A lost emergency stop must not wait for a timeout; other messages must not wait for ever.
inline constexpr Duration kRepeatAtOnce{300'000};

/// The turns that repetitions of urgent events take from the other frames.
class Repetition {
 public:
  /// Turns from now on: nothing is repeated yet.
  explicit Repetition(Time now) : others_at_(now) {}

  /// Notes whether an urgent event was sent and is not acknowledged.
  void NoteUnanswered(bool unanswered, Time now) {
    if (!unanswered) unanswered_since_.reset();
    if (unanswered && !unanswered_since_) unanswered_since_ = now;
  }
  /// Notes whether a repetition waits to be sent; none does behind a new event of its channel.
  void Step(bool waiting, Time now) {
    if (waiting && !waiting_) {
      since_ = now;
      taken_ = Duration::zero();
    }
    waiting_ = waiting;
  }
  /// Whether an urgent event has been without acknowledgement for so long.
  bool UnansweredFor(Duration time, Time now) const {
    return unanswered_since_ && now - *unanswered_since_ >= time;
  }
  /// Whether a repetition goes before the other frames.
  bool GoesFirst(Time now) const {
    if (!waiting_) return false;
    if (now < since_ + kRepeatAtOnce && now < others_at_ + kRepeatAtOnce) return true;
    return 2 * taken_ <= now - since_ - kRepeatAtOnce;
  }
  /// Notes that a repetition is sent, which takes `took` on the line.
  void OnRepeated(Time now, Duration took) {
    if (now >= since_ + kRepeatAtOnce) taken_ += took;
  }
  /// Notes that the other frames have their turn.
  void OnOthersTurn(Time now) { others_at_ = now; }

 private:
  std::optional<Time> unanswered_since_;
  bool waiting_ = false;
  Time since_{};  ///< begin of the first repetition
  Time others_at_;
  Duration taken_{};  ///< by repetitions, after those without a pause
};

}  // namespace priamos::bus::radio
