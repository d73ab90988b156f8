#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace priamos::bus::radio {

/// Consistent overhead byte stuffing (Cheshire, Baker: IEEE/ACM Transactions on Networking 7(2), 1999): the
/// same content without zero bytes, 1 byte longer per begun 254 bytes. A zero then marks only the end of a
/// frame, so that a receiver is synchronised again after the next one.
std::vector<std::byte> CobsEncode(std::span<const std::byte> content);

/// Content that was encoded; nullopt if CobsEncode cannot have made `encoded`: a zero inside, or a
/// block cut short.
std::optional<std::vector<std::byte>> CobsDecode(std::span<const std::byte> encoded);

/// Cuts a stream of bytes into frames at the delimiters. Memory is bounded: a frame longer than
/// `max_bytes` is thrown away up to its delimiter and reported as oversize.
class FrameSplitter {
 public:
  /// What a byte completed: nothing, a frame, or one that was too long and is thrown away.
  enum class Event { kNone, kFrame, kOversize };

  explicit FrameSplitter(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Takes the next byte of the stream. After kFrame, frame() holds the bytes before the delimiter until the
  /// next call.
  Event Push(std::byte byte);
  std::span<const std::byte> frame() const { return frame_; }
  /// Whether the next byte, if it is no delimiter, is the first one of a frame.
  bool between_frames() const { return complete_ || frame_.empty(); }

 private:
  std::size_t max_bytes_;
  std::vector<std::byte> frame_;
  bool complete_ = false;
  bool overflow_ = false;
};

}  // namespace priamos::bus::radio
