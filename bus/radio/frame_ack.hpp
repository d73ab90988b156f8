#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/frame/frame.hpp"
#include "bus/radio/line/link_quality.hpp"
#include "common/time.hpp"

/// Acknowledgements of frames. They cause no repetition: they name the frames that differences may refer to
/// and that short counters may count from, and measure delay and loss.
namespace priamos::bus::radio {

/// The frames of the other end that this end has to acknowledge, and when.
class FrameAckSender {
 public:
  /// A frame was accepted whose counter is `ahead` above the highest one before it; 0 for a frame that a
  /// later one overtook. Such frames are not acknowledged: states in them were dropped.
  void OnFrame(std::uint64_t ahead);
  /// Whether an acknowledgement goes into the next frame that carries control entries.
  bool Due(Time now) const;
  /// Whether a frame is not acknowledged.
  bool Any() const { return frames_ > 0; }
  /// Whether so many frames are unacknowledged that a frame is sent for the acknowledgement alone.
  bool Pressing() const;
  /// The acknowledgement; it counts as sent. `highest`: highest counter accepted; `heard_at`: arrival of that
  /// frame; `loss`: share of the other end's frames lost, 0..1.
  FrameAckEntry Take(std::uint64_t highest, Time heard_at, double loss, Time now);
  /// Makes the acknowledgement due again, because the frame with it was cut off.
  void Return();
  /// Makes an acknowledgement due, because the link is up again: the other end waits for it, to write its
  /// counters short.
  void MakeDue() { last_.reset(); }
  /// Notes that counters begin anew.
  void OnEpochChanged();

 private:
  std::uint64_t in_turn_ = 0;  ///< bit i: the frame i before the highest was accepted before any later one
  std::uint64_t frames_ = 0;   ///< accepted since the last acknowledgement
  std::optional<Time> last_;   ///< time of the last acknowledgement
};

/// The data frames of this end, and what the other end has acknowledged of them.
class SentFrames {
 public:
  /// Notes a frame that was sent. `end`: time at which its last byte leaves.
  void OnSent(std::uint64_t counter, Time end);
  /// Takes an acknowledgement; `began`: arrival of the first byte of the frame that brought it. Returns the
  /// counters that it names, in the order of sending.
  std::vector<std::uint64_t> OnAck(const FrameAckEntry& ack, Time began);
  /// The shortest form of a counter that the other end can complete.
  CounterForm FormOf(std::uint64_t counter) const;
  /// Notes that the last byte of the frame's content is handed to the line now.
  void OnHandedOver(std::uint64_t counter, Time now);
  /// Time before which the other end cannot have had the frame: who echoes its counter did so later,
  /// however long a modem, or an attacker, has held either frame. nullopt: a frame of before a restart, or an
  /// old one.
  std::optional<Time> HandedOver(std::uint64_t counter) const;
  /// Notes that the other end sent a FloorEntry: it no longer knows the highest counter that it accepted.
  void OnFloor() { confirmed_.reset(); }
  /// Notes that counters begin anew.
  void OnEpochChanged();

  /// Delay of the line, one way, estimated.
  Duration one_way() const { return latency_.one_way(); }
  /// Delay of both directions together, as measured last.
  Duration last_round_trip() const { return last_round_trip_; }
  /// Share of this end's frames that the other end lost lately, 0..1.
  double peer_loss() const { return peer_loss_; }
  /// Share that is to be expected of a frame of now: all, while the other end has not answered for longer
  /// than it ever should. What goes first when the line is back is then short.
  double ExpectedLoss(Time now) const;

 private:
  struct Frame {
    std::uint64_t counter;
    Time end;
  };
  std::deque<Frame> frames_;                ///< the last ones
  std::deque<Frame> handed_over_;           ///< more of them; `end`: when they were handed over
  std::optional<std::uint64_t> confirmed_;  ///< highest counter that the other end reported
  LatencyMeter latency_;
  Duration last_round_trip_{};
  double peer_loss_ = 0;
  std::optional<Time> acknowledged_at_;  ///< when the last acknowledgement came
};

}  // namespace priamos::bus::radio
