#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace priamos::bus {

/// Header of an LCM fragment (`LC03`), big endian: magic 4, number 4, message size 4, offset 4, fragment 2,
/// fragments 2. The first fragment has the channel and a zero before its data.
struct FragmentHeader {
  std::uint32_t number = 0;  ///< the message's number, counted by its sender
  std::uint32_t message_bytes = 0;
  std::uint32_t offset = 0;  ///< where this fragment's data begin in the message [bytes]
  std::uint16_t fragment = 0;
  std::uint16_t fragments = 0;

  static constexpr std::size_t kBytes = 20;
  /// Header at the beginning of a datagram; nullopt when there is none, or its numbers are impossible.
  static std::optional<FragmentHeader> Read(std::span<const std::byte> datagram);
  /// The header as a datagram begins with it.
  std::array<std::byte, kBytes> Write() const;
};

/// Puts the fragments of large messages together, for foreign buses that have such.
///
/// Nothing a header claims is believed: memory is taken only for bytes that have arrived, at most kMostBytes
/// over all senders; each sender has one unfinished message, which the beginning of another one drops; the
/// pieces have to fit each other exactly.
class Reassembler {
 public:
  static constexpr std::size_t kMostBytes = 64 << 20;
  static constexpr std::size_t kMostSenders = 64;

  /// A message put together from its fragments.
  struct Message {
    std::string channel;
    std::vector<std::byte> bytes;
  };
  /// What a datagram did, see Add.
  enum class Result { kWaiting, kBegun, kComplete, kMalformed };

  /// Takes one datagram that begins with `LC03`. kBegun: it is the first one heard of its message;
  /// kComplete: `message` is whole (kBegun was returned before, as no message has only one fragment).
  Result Add(std::uint64_t sender, std::span<const std::byte> datagram, Message& message);

  /// Messages that began and never became whole.
  std::uint64_t abandoned() const { return abandoned_; }
  /// Memory held by unfinished messages.
  std::size_t held_bytes() const { return held_bytes_; }

 private:
  struct Piece {
    std::uint32_t offset = 0;
    std::vector<std::byte> bytes;
    std::size_t Cost() const { return bytes.size() + 100; }  ///< with its place in the map, about
  };
  struct Partial {
    FragmentHeader header;  ///< header of the first fragment received
    std::map<std::uint16_t, Piece> pieces;
    std::optional<std::uint32_t> finished;  ///< number of the newest whole message
    std::uint64_t heard = 0;
  };
  Partial& PartialOf(std::uint64_t sender);
  void Drop(Partial& partial);
  void MakeRoom(std::size_t bytes);
  Result Finish(Partial& partial, Message& message);
  static bool Join(const Partial& partial, Message& message);

  std::map<std::uint64_t, Partial> partials_;
  std::uint64_t datagrams_ = 0, abandoned_ = 0;
  std::size_t held_bytes_ = 0;
};

}  // namespace priamos::bus
