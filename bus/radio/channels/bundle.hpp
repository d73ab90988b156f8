#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/channels/event_stream.hpp"
#include "bus/schema/bit_stream.hpp"

/// What a data frame carries: entries one after the other, bit by bit. Each begins with a channel number, 0
/// ends the bundle (the zeros that fill the last byte are such an end).
namespace priamos::bus::radio {

/// Entry of a state message, or of the difference to the one in an earlier frame, named by the low bits of
/// its counter.
struct StateEntry {
  std::size_t channel = 0;
  std::size_t bits = 0;
  std::vector<std::byte> packed;
  std::optional<std::uint8_t> baseline{};
};

/// Steps of a command's offset in one time-to-live of its channel.
inline constexpr std::int64_t kOffsetSteps = 32;

/// Entry of a command message. Its offset travels in steps of the channel's time-to-live / kOffsetSteps, from
/// -32 to 31 of them, rounded down: what is lost makes the command older, never younger.
struct CommandEntry {
  std::size_t channel = 0;
  Duration offset{};  ///< from the arrival of the frame that this one echoes to the offer; may be negative
  std::size_t bits = 0;
  std::vector<std::byte> packed;
};

/// Entry of one segment of an event.
struct EventEntry {
  std::size_t channel = 0;
  EventSegment segment;
};

/// The segment that a run of segments can go on with.
struct EventRun {
  std::size_t channel = 0;
  std::uint8_t number = 0;
};

/// Acknowledgement of the events of one channel.
struct EventAckEntry {
  std::size_t channel = 0;
  EventAck ack;
};

/// Frames before the last one whose receipt an acknowledgement reports as well.
inline constexpr int kEarlierFrames = 4;

/// Acknowledgement of frames: which one of the other end came last, and which shortly before.
struct FrameAckEntry {
  std::uint16_t counter = 0;  ///< lowest 12 bits
  std::uint8_t earlier = 0;   ///< bit i: the frame 1 + i before it also came, and in order
  Duration hold{};            ///< time from the arrival of that frame to the begin of this one
  double loss = 0;            ///< share of the other end's frames that did not arrive lately, 0..1
};

/// Order to use only counters above `counter`: sent by an end that restarted with counters reserved ahead.
struct FloorEntry {
  std::uint64_t counter = 0;
};

/// List of the on-request channels that somebody listens to; bit i is channel i.
struct ListenEntry {
  std::uint64_t channels = 0;
};

/// Request to forget baselines: the sender does not have a message that a difference referred to.
struct ForgetEntry {};

/// Announcement of the key that the sender is ready to change to, see NextKey.
struct NextKeyEntry {
  std::uint32_t check = 0;  ///< see KeyCheck
};

/// End of a turn of a half-duplex radio: the sender falls silent after this frame and listens.
struct OverEntry {};

using BundleEntry = std::variant<StateEntry, CommandEntry, EventEntry, EventAckEntry, FrameAckEntry,
                                 FloorEntry, ListenEntry, OverEntry, ForgetEntry, NextKeyEntry>;

/// Code of a duration, 3 bits exponent and 9 bits mantissa. Resolution: 1 ms up to 0.5 s, then 4, 16, 64 ms
/// ...; range: 2.3 hours.
std::uint16_t EncodeDuration12(Duration d);
Duration DecodeDuration12(std::uint16_t code);

/// A bundle in the making. Segments of one channel that follow each other, as those of many events do, are
/// written as a run: without their channel and number. Urgent ones travel alone, and are spared the bit that
/// says whether a run goes on.
class BundleWriter {
 public:
  /// Empty bundle; `table` must outlive the writer.
  explicit BundleWriter(const ChannelTable& table) : table_(&table) {}

  void Write(const BundleEntry& entry);
  std::size_t bits() const { return out_.bits(); }
  /// Number of bits that the bundle would have with this entry.
  std::size_t BitsWith(const BundleEntry& entry) const;
  std::vector<std::byte> bytes() const { return out_.bytes(); }
  /// The bundle; the writer is used up.
  std::vector<std::byte> Finish() { return out_.Finish(); }

 private:
  const ChannelTable* table_;
  BitWriter out_;
  std::optional<EventRun> run_;  ///< ended by the next entry, or by the end of the bundle
};

/// Entries of a received bundle, in their order.
struct ParsedBundle {
  std::vector<BundleEntry> entries;
  bool whole = true;  ///< false: the rest could not be read
};

/// Reads a bundle from the other end: `incoming` channels only carry messages, acknowledgements are for
/// channels of the other direction. Anything else ends the reading.
ParsedBundle ParseBundle(const ChannelTable& table, Direction incoming, std::span<const std::byte> bundle);

}  // namespace priamos::bus::radio
