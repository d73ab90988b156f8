#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "bus/radio/channels/bundle.hpp"
#include "bus/radio/frame/frame.hpp"
#include "bus/radio/line/link_quality.hpp"
#include "common/time.hpp"

/// Acknowledgements of frames. They cause no repetition: they prove that commands are fresh, name the frames
/// that differences may refer to, and measure delay and loss.
namespace priamos::bus::radio {

/// The frames of the other end that this end has to acknowledge, and when.
class FrameAckSender {
 public:
  /// A frame was accepted whose counter is `ahead` above the highest one before it; 0 for a frame that a
  /// later one overtook. Such frames are not acknowledged: states in them were dropped.
  void OnFrame(std::uint64_t ahead);
  /// Whether an acknowledgement goes into the next frame that carries control entries.
  bool Due(Time now) const;
  /// Whether so many frames are unacknowledged that a frame is sent for the acknowledgement alone.
  bool Pressing() const;
  /// The acknowledgement; it counts as sent. `highest`: highest counter accepted; `heard_at`: arrival of that
  /// frame; `loss`: share of the other end's frames lost, 0..1.
  FrameAckEntry Take(std::uint64_t highest, Time heard_at, double loss, Time now);
  /// Makes the acknowledgement due again, because the frame with it was cut off.
  void Return();
  /// Makes an acknowledgement due, because the link is up again: the other end waits for an acknowledgement,
  /// to know that commands are fresh.
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
  /// Whether a command that was received now and lives for `ttl` is fresh. A modem, or an attacker, may have
  /// held the frame back; it is not older than the newest frame from here that the other end had received
  /// when it was made.
  bool ProvesFresh(Duration ttl, Time now) const;
  /// Notes that the other end sent a FloorEntry: it no longer knows the highest counter that it accepted.
  void OnFloor() { confirmed_.reset(); }
  /// Notes that counters begin anew.
  void OnEpochChanged();

  /// Delay of the line, one way, estimated.
  Duration one_way() const { return latency_.one_way(); }
  /// Share of this end's frames that the other end lost lately, 0..1.
  double peer_loss() const { return peer_loss_; }

 private:
  struct Frame {
    std::uint64_t counter;
    Time end;
  };
  std::deque<Frame> frames_;                ///< the last ones
  std::optional<std::uint64_t> confirmed_;  ///< highest counter that the other end reported
  std::optional<Time> proven_;              ///< end of the newest frame that the other end had received
  LatencyMeter latency_;
  double peer_loss_ = 0;
};

}  // namespace priamos::bus::radio
