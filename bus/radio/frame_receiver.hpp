#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "bus/radio/frame/cobs.hpp"
#include "bus/radio/frame/coded_block.hpp"
#include "bus/radio/frame/frame.hpp"
#include "bus/radio/handshake.hpp"
#include "bus/radio/line/link_quality.hpp"

namespace priamos::bus::radio {

/// A data frame that passed every check.
struct AcceptedFrame {
  DataFrame frame;
  /// Increase of the frame counter over the highest one before; 0 when a later frame overtook this one.
  std::uint64_t ahead = 0;
  std::size_t wire_bytes = 0;  ///< length on the line, delimiter included
  Time first_byte{};           ///< arrival of its first byte
  bool link_back = false;      ///< the link was down before this frame
};

/// A hello under the next key.
struct NextKeyHello {
  Hello hello;
};

/// A frame of the other end, for its echo.
struct HeardFrame {
  std::uint64_t counter = 0;
  Time at{};  ///< arrival of its last byte
  LineCode line_code = LineCode::kCobs;
};

/// Counters of what came from the line.
struct ReceptionCounters {
  std::uint64_t bytes = 0;
  std::uint64_t frames = 0;                        ///< data frames accepted
  std::uint64_t missed = 0;                        ///< counters of the other end that never came
  std::array<std::uint64_t, kRejects> rejected{};  ///< by Reject
};

/// Turns bytes of the line into authenticated frames, and counts how well that goes.
class FrameReceiver {
 public:
  /// The frame that a byte completed: none, a hello or data.
  using Result = std::variant<std::monostate, Hello, NextKeyHello, AcceptedFrame>;

  /// Receiver of frames that travel in the direction `incoming`. `bytes_per_s`: what the line can carry;
  /// frames that come faster are not checked. `silence`: the link is down when nothing was accepted for so
  /// long.
  FrameReceiver(const FrameKeys& keys, Direction incoming, FrameScope scope, double bytes_per_s,
                Duration silence, Time now);

  /// Accepts from now on data frames of `epoch` with counters above `floor`. Epoch 0: no data frames.
  void SetEpoch(std::uint64_t epoch, std::uint64_t floor);
  /// Opens hellos under the next key, too: the code of a data frame is still computed once.
  void SetNextKey(FrameOpener next) { next_opener_ = next; }
  /// Opens from now on what is under the next key, and nothing else.
  void UseNextKey();
  /// The next byte of the line. `newest_sent`: see FrameOpener::Open.
  Result Push(std::byte byte, Time now, std::uint64_t newest_sent = 0);
  /// A whole frame without its delimiter, beside the bytes of Push(), as IP brings it. `stranger`: it does
  /// not come from where the other end is known to be; as long as that one is heard, few of these are
  /// checked.
  Result Take(std::span<const std::byte> frame, Time first_byte, Time now, std::uint64_t newest_sent,
              bool stranger);

  Reception reception(Time now) const;
  /// Whether no data frame was accepted of late.
  bool Down(Time now) const { return !heard_at_ || now - *heard_at_ > silence_; }
  /// Whether frames came that the other end cannot have sent.
  bool alarm(Time now) const { return guard_.alarm(now); }
  /// Highest counter accepted, or the floor.
  std::uint64_t highest() const { return opener_.highest(); }
  /// Arrival of the last data frame accepted; the beginning of time before the first.
  Time heard_at() const { return heard_at_.value_or(Time{}); }
  /// The frame with the highest counter that was accepted in this epoch and in this life.
  const std::optional<HeardFrame>& newest() const { return newest_; }
  const LossMeter& loss() const { return loss_; }
  const ReceptionCounters& counters() const { return counters_; }

 private:
  /// What came between two delimiters.
  struct Incoming {
    std::vector<std::byte> content;
    std::size_t wire_bytes;  ///< on the line, delimiter included
    Time first_byte;         ///< arrival of its first byte
    LineCode line_code = LineCode::kCobs;
    bool stranger = false;
  };
  Result OnEncoded(std::span<const std::byte> encoded, Time first_byte, Time now, std::uint64_t newest_sent,
                   bool stranger);
  Result OnContent(Incoming incoming, Time now, std::uint64_t newest_sent);
  Result OnFrame(const Incoming& incoming, Time now, std::uint64_t newest_sent);
  bool Expected(const FrameHead& head, Time now) const;
  AcceptedFrame Accept(DataFrame frame, const Incoming& incoming, std::uint64_t highest_before, Time now);
  Result OnReject(Reject reject, Time now);

  FrameSplitter splitter_;
  BlockFinder blocks_;
  FrameOpener opener_;
  std::optional<FrameOpener> next_opener_;  ///< of hellos under the next key
  ForgeryGuard guard_;
  LossMeter loss_;
  Duration silence_;
  Time first_byte_;               ///< arrival of the first byte of the frame that is coming in
  std::optional<Time> heard_at_;  ///< arrival of the last accepted data frame
  double frames_per_s_;           ///< what the line can carry
  std::optional<HeardFrame> newest_;
  std::optional<std::uint64_t> newest_echo_;  ///< of the newest frame that had one
  std::uint64_t unusable_ = 0;   ///< frames with a wrong code or a used counter since `heard_at_`
  std::uint64_t malformed_ = 0;  ///< pieces without the form of a frame since then
  ReceptionCounters counters_;
};

}  // namespace priamos::bus::radio
