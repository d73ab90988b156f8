#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "bus/schema/bit_stream.hpp"

/// State messages as differences to one that the other end is known to have: only against an acknowledged
/// baseline, so a lost frame never makes a later one unreadable or wrong.
namespace priamos::bus::radio {

/// Bits of the values of a message of fixed size, in the order of the bits; each 1 to 64.
using ValueWidths = std::vector<std::uint8_t>;

/// Largest number of frames between a baseline and a difference to it.
inline constexpr std::uint64_t kDeltaReach = 63;
/// Bits that name a baseline.
inline constexpr int kBaselineBits = 6;

/// Difference of a message to a baseline. Code of each value: bit 0 if unchanged; bits 10 and a small
/// difference; bits 11 and the value. Values of up to 4 bits: 0, or 1 and the value. Both messages have the
/// bits that the widths add up to.
BitWriter EncodeDelta(const ValueWidths& widths, std::span<const std::byte> baseline,
                      std::span<const std::byte> message);

/// Reads one encoded difference without applying it: its length follows from the widths alone. The reader's
/// ok() is false if it was cut off.
std::vector<std::byte> TakeDelta(const ValueWidths& widths, BitReader& in);

/// Message that a difference to `baseline` stands for; nullopt when the bits end early.
std::optional<std::vector<std::byte>> ApplyDelta(const ValueWidths& widths,
                                                 std::span<const std::byte> baseline,
                                                 std::span<const std::byte> delta);

/// History of one channel: messages and the counters of the frames that carried them, as far back as a
/// difference can reach.
class MessageHistory {
 public:
  /// A packed message and the counter of the frame that carried it.
  struct Message {
    std::uint64_t counter = 0;
    std::vector<std::byte> packed;
  };
  /// Adds a message; counters must ascend.
  void Note(std::uint64_t counter, std::vector<std::byte> packed);
  /// The message with this counter; nullptr if there is none.
  const Message* Find(std::uint64_t counter) const;
  void Clear() { messages_.clear(); }

 private:
  std::deque<Message> messages_;
};

/// Sender's side of one channel: the messages sent, and the baseline of differences.
class DeltaSender {
 public:
  void OnSent(std::uint64_t counter, std::vector<std::byte> packed) {
    sent_.Note(counter, std::move(packed));
  }
  /// Notes that the other end acknowledged the frame with this counter.
  void OnAcknowledged(std::uint64_t counter);
  /// The other end has lost its memory.
  void Forget();
  /// The baseline for a message in the frame with this counter; nullptr if there is none.
  const MessageHistory::Message* Baseline(std::uint64_t counter) const;

 private:
  MessageHistory sent_;
  std::optional<MessageHistory::Message> baseline_;
};

/// The counter below `counter`, at most kDeltaReach away, with these low bits; 0 when there is none.
std::uint64_t BaselineCounter(std::uint64_t counter, std::uint8_t low_bits);

}  // namespace priamos::bus::radio
