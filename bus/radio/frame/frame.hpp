#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "bus/radio/frame/replay_window.hpp"

/// Frames on the line; bus/radio/PROTOCOL.md is the byte-exact specification.
///
///     data   COBS( counter:1 | echo:0-2 | bundle | code:4, 6 or 8 ) 0x00  the shortest form
///     data   COBS( 0x80 | counter:5 | bundle | code:4, 6 or 8 ) 0x00      the same with the whole counter
///     hello  COBS( 0x81 | body:25 | code:8 ) 0x00                 agreement on an epoch, see epoch.hpp
///
/// On a channel that several robots share, the address of the robot precedes each content.
///
/// On a line that damages frames, what is urgent travels in blocks that correct errors instead of COBS, see
/// coded_block.hpp.
///
/// The code is a keyed BLAKE2b hash over direction, epoch, whole counter, channel table and clear bundle, so
/// that a frame of another direction, epoch, counter or table never passes, although none of them is sent.
/// The echo is the counter of the newest frame that the sender has accepted, of which the whole is in the
/// code and the lowest bytes are sent: the receiver learns how old the frame can be at most, by its own
/// clock.
namespace priamos::bus::radio {

/// Which end sends.
enum class Direction : std::uint8_t {
  kUp = 0,   ///< sent by the onboard end
  kDown = 1  ///< sent by the offboard end
};
constexpr Direction Opposite(Direction d) {
  return d == Direction::kUp ? Direction::kDown : Direction::kUp;
}
/// As link.toml, LINK_STATUS and summary.json say it.
constexpr const char* NameOf(Direction d) {
  return d == Direction::kUp ? "up" : "down";
}

/// Secret key that both ends have.
using LinkKey = std::array<std::uint8_t, 32>;

/// Number that names a link key and says nothing else of it; never 0.
std::uint32_t KeyCheck(const LinkKey& link_key);

/// Keys for one purpose each, derived from the key in the file.
class FrameKeys {
 public:
  explicit FrameKeys(const LinkKey& link_key);

  /// Authentication code of a frame: the first `out.size()` bytes, at most 16.
  void Authenticate(std::span<const std::uint8_t> header, std::span<const std::byte> body,
                    std::span<std::byte> out) const;
  /// Adds or removes the key stream of one frame (ChaCha20, RFC 8439). It depends on the code, which depends
  /// on the text: two texts have two key streams even when a counter is used twice, because somebody set an
  /// end's memory back (a synthetic initial vector: Rogaway, Shrimpton: Eurocrypt 2006).
  void Crypt(Direction direction, std::uint64_t epoch, std::uint64_t counter, std::span<const std::byte> code,
             std::span<std::byte> body) const;
  /// Name of the epoch that two fresh random numbers make; never 0.
  std::uint64_t EpochOf(std::uint64_t onboard_nonce, std::uint64_t offboard_nonce) const;

 private:
  LinkKey authentication_key_;
  LinkKey encryption_key_;
};

/// Bytes of the shortest code of a data frame; forgery.hpp says which line needs a longer one.
inline constexpr std::size_t kShortCodeBytes = 4;
/// Bytes of the longest one.
inline constexpr std::size_t kLongCodeBytes = 8;

/// What both ends must have in common, besides the key, for a data frame to be accepted.
struct FrameScope {
  std::uint32_t table_hash = 0;  ///< hash of the channel table, see channel_table.hpp
  bool encrypted = false;
  std::size_t echo_bytes = 0;  ///< bytes of the echo in a short frame; 0: the direction has no commands
  std::size_t code_bytes = kShortCodeBytes;  ///< bytes of the code of a data frame: 4, 6 or 8
  std::uint8_t address = 0;  ///< of the robot on a channel that several share; 0: a link of two ends

  /// Bytes of the address in a frame.
  std::size_t address_bytes() const { return address != 0 ? 1 : 0; }
};

/// Bytes of the echo in the short frames of a direction with commands, on a line of this rate.
constexpr std::size_t EchoBytes(double bytes_per_s) {
  return bytes_per_s <= 2000 ? 1 : 2;
}

/// Body of a hello frame; epoch.hpp defines how it is used.
struct Hello {
  std::uint32_t table_hash = 0;
  std::uint32_t stream = 0;  ///< names the sender's event numbering: a new one begins at 0
  std::uint64_t nonce = 0;   ///< the sender's random number
  std::uint64_t echo = 0;    ///< the receiver's random number as the sender received it; 0 before
  bool need = false;         ///< the sender cannot use the receiver's frames and asks for an answer
  bool agreed = false;       ///< the sender uses the epoch of (nonce, echo)
  bool over = false;         ///< half-duplex: the sender falls silent and listens
  std::size_t code_bytes = kShortCodeBytes;  ///< of the sender's data frames
  friend bool operator==(const Hello&, const Hello&) = default;
};

/// Bytes of a short data frame beside its bundle and its echo, delimiter included.
constexpr std::size_t FrameOverhead(std::size_t code_bytes) {
  return 3 + code_bytes;
}
/// The same with the shortest code.
inline constexpr std::size_t kFrameOverhead = FrameOverhead(kShortCodeBytes);
/// Bytes by which the whole counter is longer than its lowest bits.
inline constexpr std::size_t kWholeCounterBytes = 5;
/// Bytes of a hello frame, delimiter included.
inline constexpr std::size_t kHelloFrameBytes = 36;
/// Bytes of the longest bundle: a frame with the longest code must fit one COBS block.
inline constexpr std::size_t kMaxBundleBytes = 240;
/// The byte that ends a frame and occurs nowhere else.
inline constexpr std::byte kDelimiter{0};
/// Bytes of the heads of IPv4 and UDP, for links that carry a frame per datagram.
inline constexpr std::size_t kDatagramHead = 28;

/// How a counter is written in a frame: its lowest bits, or all of it.
enum class CounterForm { kLowBits, kWhole };
/// What a content is written as: COBS, or where it fits one a block that corrects errors.
enum class LineCode { kCobs, kBlock };

/// Makes the frames of one direction, delimiter included.
class FrameSealer {
 public:
  FrameSealer(const FrameKeys& keys, Direction direction, FrameScope scope)
      : keys_(keys), direction_(direction), scope_(scope) {}

  /// Makes a data frame. `counter` is below 2^40 and used once per epoch; `bundle` at most kMaxBundleBytes.
  /// The lowest bits are enough if the receiver has accepted a counter at most 64 below this one. `echo`:
  /// counter of the newest frame accepted from the receiver; the short frames of a direction with commands
  /// carry it. For a block the bundle is filled up with zeros.
  std::vector<std::byte> Seal(std::uint64_t epoch, std::uint64_t counter, CounterForm form,
                              std::span<const std::byte> bundle, std::uint64_t echo = 0,
                              LineCode line_code = LineCode::kCobs) const;
  std::vector<std::byte> Seal(const Hello& hello, LineCode line_code = LineCode::kCobs) const;
  std::size_t echo_bytes() const { return scope_.echo_bytes; }
  /// Bytes of a short frame beside its bundle, delimiter included.
  std::size_t overhead() const {
    return FrameOverhead(scope_.code_bytes) + scope_.echo_bytes + scope_.address_bytes();
  }
  std::size_t code_bytes() const { return scope_.code_bytes; }
  /// Bytes of the longest bundle of a frame that can be a block.
  std::size_t MaxBlockBundle(CounterForm form) const;
  /// Bytes on the line of a frame with such a bundle, delimiter included.
  std::size_t WireBytes(CounterForm form, std::size_t bundle_bytes, LineCode line_code) const;

 private:
  std::size_t HeadBytes(CounterForm form) const;
  std::vector<std::byte> HeadOf(CounterForm form, std::uint64_t counter, std::uint64_t echo) const;

  FrameKeys keys_;
  Direction direction_;
  FrameScope scope_;
};

/// Why bytes between two delimiters were no frame.
enum class Reject : std::uint8_t {
  kMalformed,  ///< not the form of a frame: cut off (also by an urgent frame) or damaged
  kOversize,   ///< longer than any frame
  kBadCode,    ///< wrong code: damaged, forged, of another direction, epoch, table or key
  kReplayed,   ///< right code, but its counter was used
  kNoEpoch,    ///< a data frame before the ends agreed on an epoch
  kFlood       ///< more frames than the line can carry: not checked
};
inline constexpr std::size_t kRejects = 6;

/// Content of a data frame that was accepted.
struct DataFrame {
  std::uint64_t counter = 0;
  std::vector<std::byte> bundle;
  /// Counter of the newest frame that its sender had accepted from here when it was made, if it says so.
  std::optional<std::uint64_t> echo{};
};
/// What a frame says of itself before its code is checked: nothing of it is proven.
struct FrameHead {
  bool hello = false;
  std::uint64_t counter = 0;            ///< of a data frame, completed
  std::optional<std::uint64_t> echo{};  ///< the same
};
/// What lay between two delimiters.
using Opened = std::variant<DataFrame, Hello, Reject>;

/// Checks the frames of one direction. A data frame is accepted once.
class FrameOpener {
 public:
  /// Opener of frames that travel in `direction`.
  FrameOpener(const FrameKeys& keys, Direction direction, FrameScope scope)
      : keys_(keys), direction_(direction), scope_(scope) {}

  /// Accepts from now on data frames of `epoch` with counters above `floor`. Epoch 0: no data frames.
  void SetEpoch(std::uint64_t epoch, std::uint64_t floor);
  /// Checks and decodes the content of a frame. Exactly one code is computed per frame, so that the chance of
  /// a forged data frame is 2^-32 with the shortest code, of a hello 2^-64. `newest_sent`: the newest counter
  /// that this end has sent in the epoch. An echo of one 256 (with 2 bytes: 65536) or more below it is a
  /// wrong code.
  Opened Open(std::span<const std::byte> content, std::uint64_t newest_sent = 0);
  /// Whether a content is for this end, or of its robot: always so on a link of two ends. The other members
  /// take the content from behind the address on.
  bool Addressed(std::span<const std::byte> content) const;
  /// Bytes of the address before a content.
  std::size_t address_bytes() const { return scope_.address_bytes(); }
  /// Head of a content, which costs no code; nullopt when it has not the form of a frame.
  std::optional<FrameHead> Look(std::span<const std::byte> content, std::uint64_t newest_sent = 0) const;
  /// Epoch of the frames that are accepted; 0: none.
  std::uint64_t epoch() const { return epoch_; }
  /// Highest counter accepted, or the floor.
  std::uint64_t highest() const { return window_.highest(); }

 private:
  struct DataHead {
    std::size_t body_at;
    std::uint64_t counter;
    std::optional<std::uint64_t> echo;
  };
  bool Proves(std::span<const std::byte> code, const DataHead& head, std::span<const std::byte> bundle) const;
  std::optional<DataHead> HeadOf(std::span<const std::byte> content, std::uint64_t newest_sent) const;
  Opened OpenData(std::span<const std::byte> content, std::uint64_t newest_sent);
  Opened OpenHello(std::span<const std::byte> content) const;

  FrameKeys keys_;
  Direction direction_;
  FrameScope scope_;
  std::uint64_t epoch_ = 0;
  ReplayWindow window_;
};

}  // namespace priamos::bus::radio
