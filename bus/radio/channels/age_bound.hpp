#pragma once

#include <cstddef>
#include <optional>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/channels/send_queue.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// Keeps the newest message of one state at the other end young: `fresh_s` of link.toml.
///
/// Each frame with one of its messages has left within that time of the beginning of the frame with the one
/// before. So one that is offered after any moment has left within that time and the time until it is
/// offered. For that it goes before its rate lets it, where a frame without it would be too long; and a
/// message that is longer than a bundle, and goes alone, waits for one short frame with it. That message is
/// then the next, whatever comes meanwhile.
///
/// Pure; it decides what goes first, and knows neither bytes nor the line.
class AgeBound {
 public:
  /// Ticks, and what the line takes beside its bytes.
  static constexpr Duration kMargin{4'000};

  /// Of the channel with a bound in this direction; of none without such a channel.
  AgeBound(const ChannelTable& table, Direction direction);

  bool enabled() const { return channel_.has_value(); }
  /// Only if enabled().
  std::size_t channel() const { return *channel_; }
  Duration within() const { return within_; }
  /// Bytes of the largest entry of a message of the channel.
  std::size_t entry_bytes() const { return entry_bytes_; }

  /// What waits when a frame begins, and how long frames with it take.
  struct Waiting {
    std::optional<SendQueue::Candidate> state{};  ///< the newest message of the channel
    /// A message that goes alone: the one promised(), or one that is next in the order of the queue.
    std::optional<SendQueue::Candidate> alone{};
    Duration state_takes{};    ///< a frame with the state alone, and a hello before it
    Duration alone_takes{};    ///< one with that message
    Duration others_take{};    ///< one with all else that waits, or as much of it as fits
    Duration longest_takes{};  ///< one that is as full as can be
  };
  /// What goes first in a frame, by when that must have left, and what goes first in the next one.
  struct First {
    SendQueue::Candidate message;
    Time end{};
    std::optional<SendQueue::Candidate> promised{};
  };
  /// What goes first in a frame that begins at `begin`; nullopt: the order of the queue decides.
  std::optional<First> Choose(const Waiting& waiting, Time begin) const;
  /// The message that goes alone in this frame: the last one was short for its sake.
  const std::optional<SendQueue::Candidate>& promised() const { return now_.promised; }

  /// Notes that a frame begins, with a message of the channel or without.
  void OnFrame(bool with_state, const std::optional<First>& first, Time now);
  /// Reverts the last OnFrame(): the frame was cut off.
  void Undo() { now_ = before_; }

 private:
  struct State {
    std::optional<Time> last{};  ///< begin of the last frame with a message of the channel
    std::optional<SendQueue::Candidate> promised{};
  };
  Time DueAfter(Time begun) const { return begun + within_ - kMargin; }

  std::optional<std::size_t> channel_;
  std::size_t entry_bytes_ = 0;
  Duration within_{};
  State now_, before_;
};

}  // namespace priamos::bus::radio
