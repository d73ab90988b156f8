#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bus/radio/channels/delta.hpp"
#include "bus/radio/frame/frame.hpp"
#include "common/input/section_place.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// How the messages of a channel are treated.
enum class ChannelClass : std::uint8_t {
  kState,   ///< the newest replaces older ones, expires; a lost one is replaced by the next
  kEvent,   ///< acknowledged, in order, exactly once
  kCommand  ///< the newest replaces older ones, expires; the receiver refuses one that is too old
};

/// One channel that crosses the link, as both ends know it.
struct LinkChannel {
  std::string name;
  std::uint64_t fingerprint = 0;  ///< names its message type and the codes of its packing
  Direction direction = Direction::kUp;
  ChannelClass channel_class = ChannelClass::kState;
  std::uint32_t fixed_bits = 0;  ///< packed size if it is always the same; 0: it is sent with every message
  std::uint32_t max_bits = 0;    ///< largest packed size
  ValueWidths delta{};           ///< state: widths of its values, for differences; empty: always sent whole
  // Settings of the sender; the receiver does not need them.
  int priority = 3;         ///< 0 first
  double rate_hz = 1;       ///< at most this often (per key), on average; 0: no limit
  int burst = 1;            ///< number of messages that may come at once
  Duration ttl{};           ///< not sent (command: not delivered) when older; 0: lives until replaced
  bool urgent = false;      ///< may abort the frame that is being sent
  bool on_request = false;  ///< sent only while the other side has a listener
  int max_keys = 1;         ///< state: newest wins per key, for so many keys
  Duration deadline{};      ///< latest delivery after it was offered, for the budget; 0: any
  /// State: from any moment on, a message that was made after it has left within this time; 0: no bound.
  Duration fresh{};
  SectionPlace place{};  ///< where it is configured, for errors

  /// What an error about one of its keys begins with, `file:line:key: radio channel NAME`.
  std::string At(std::string_view key) const { return place.Of(key) + ": radio channel " + name; }
};

/// All channels of a link. The index is the channel's name on the wire.
class ChannelTable {
 public:
  static constexpr std::size_t kMaxChannels = 62;

  /// Table of `channels` in this order. `code_bytes`: length of the codes of data frames, 4, 6 or 8. Throws
  /// std::invalid_argument with a sentence if it cannot be used.
  ChannelTable(std::vector<LinkChannel> channels, bool encrypted, std::size_t code_bytes = kShortCodeBytes);

  const LinkChannel& at(std::size_t index) const { return channels_[index]; }
  std::size_t size() const { return channels_.size(); }
  const std::vector<LinkChannel>& channels() const { return channels_; }
  /// Hash of everything that changes the meaning of a frame: both ends must have the same. Rates and
  /// priorities concern the sender alone and are not part of it.
  std::uint32_t hash() const { return hash_; }
  /// The text of which hash() is the hash: see PROTOCOL.md.
  std::string Text() const;
  bool encrypted() const { return encrypted_; }
  /// Bytes of the code of a data frame.
  std::size_t code_bytes() const { return code_bytes_; }
  /// Whether a channel of this direction is a command.
  bool HasCommands(Direction direction) const;
  /// Bits of a channel number in a bundle: 0 ends it, 1..size() are channels, size()+1 is a control entry.
  int id_bits() const { return id_bits_; }

 private:
  std::vector<LinkChannel> channels_;
  bool encrypted_;
  std::size_t code_bytes_;
  std::uint32_t hash_;
  int id_bits_;
};

}  // namespace priamos::bus::radio
