#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "common/time.hpp"

/// Contents of frames in a form that survives damage: symbols of 7 bits and their parity, a byte each, whose
/// highest bit is set. So no byte is the delimiter, and damage to the highest bit harms nothing.
namespace priamos::bus::radio {

/// Bytes of the smallest block that holds a content of so many bytes; 0 if none is large enough. A shorter
/// content is filled up before it is encoded.
std::size_t BlockBytes(std::size_t content_bytes);
/// Bytes on the line of a block of BlockBytes(), without a delimiter.
std::size_t EncodedBlockBytes(std::size_t block_bytes);
/// Bytes of the largest block.
inline constexpr std::size_t kMaxBlockBytes = 34;

/// Encodes a content of exactly BlockBytes().
std::vector<std::byte> EncodeBlock(std::span<const std::byte> content);
/// Content of a block as it came, of which up to four bytes may be wrong, or one lost and three wrong (but
/// for one in a thousand: a shifted word may be a word, too); nullopt if it is none.
std::optional<std::vector<std::byte>> DecodeBlock(std::span<const std::byte> received);

/// Finds blocks among the bytes of a line. Damage makes delimiters and takes them away: a block is looked for
/// in front of every one, whatever came between, and where one should be. Memory and time per byte are
/// bounded.
class BlockFinder {
 public:
  /// A block that was found, and what it took on the line [bytes].
  struct Found {
    std::vector<std::byte> content;
    std::size_t wire_bytes = 0;  ///< on the line, delimiter included
    Time first_byte{};           ///< arrival of its first byte
  };

  /// Takes the next byte of the line; returns the block that ended before it.
  std::optional<Found> Push(std::byte byte, Time now);

 private:
  std::optional<Found> AtDelimiter(std::size_t since_the_last) const;
  std::optional<Found> LastBytes(std::size_t count) const;

  struct Arrival {
    std::byte byte;
    Time at;
  };
  std::deque<Arrival> bytes_;        ///< the last ones
  std::size_t since_delimiter_ = 0;  ///< bytes after the last delimiter
};

}  // namespace priamos::bus::radio
