#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bus/radio/line/duty_cycle.hpp"
#include "bus/radio/line/pacer.hpp"
#include "bus/radio/link_options.hpp"

namespace priamos::bus::radio {

/// The frame that is being sent, handed over byte by byte at the pace of the line, or whole as a datagram. It
/// knows nothing of what the bytes mean.
class Transmitter {
 public:
  Transmitter(const LinkOptions& options, Time now);

  /// Whether a frame has bytes left to send.
  bool busy() const { return next_ < wire_.size(); }
  /// True once per frame: after the Emit() that hands over the last byte of its content. What is left is the
  /// delimiter, which noise can stand in for.
  bool ContentHandedOver() const { return wire_.size() - next_ == (datagrams_ ? 0U : 1U); }
  /// Whether cutting the frame off now gains time over finishing it.
  bool WorthCutting() const;
  /// Whether the line can take a byte (a datagram) now.
  bool Allows(Time now) const { return pacer_.Allows(now); }
  /// Whether the duty cycle of the radio lets a frame begin.
  bool MayBegin(Time now, bool urgent) const { return duty_.Allows(now, urgent); }

  /// Begins a frame, delimiter included; not while busy().
  void Begin(std::vector<std::byte> wire, Time now);
  /// Appends the next byte of the frame, or all of a datagram, to `out`; only while busy().
  void Emit(Time now, std::vector<std::byte>& out);
  /// Aborts the frame. The part that has left is ended by a delimiter, so that the receiver discards it.
  void Cut(Time now, std::vector<std::byte>& out);
  /// Aborts the frame without another byte: who is not to talk any more.
  void Drop();
  /// Time at which the rest of the frame will have left, if it goes on from `now`.
  Time RestLeavesAt(Time now) const { return pacer_.LeavesAt(wire_.size() - next_, now); }

  /// Time that the `bytes` of a frame take on the line, a packet's overhead included; 0 for a datagram of IP.
  Duration OnTheWay(std::size_t bytes) const;
  /// Time for which a frame of so many bytes occupies the line, head of a datagram included.
  Duration Occupies(std::size_t bytes) const;
  /// Time at which `bytes` of a frame begun now will have left.
  Time LeavesAt(std::size_t bytes, Time now) const;
  /// Pace of the line.
  const Pacer& pacer() const { return pacer_; }
  std::uint64_t bytes_sent() const { return bytes_sent_; }

 private:
  void Put(std::byte byte, Time now, std::vector<std::byte>& out);

  Pacer pacer_;
  DutyCycle duty_;
  bool datagrams_;
  bool instant_;                 ///< a datagram leaves when it is handed over
  std::size_t head_bytes_;       ///< charged to a datagram beside its bytes
  std::vector<std::byte> wire_;  ///< the frame, delimiter included
  std::size_t next_ = 0;         ///< first byte of `wire_` that has not left
  std::uint64_t bytes_sent_ = 0;
};

}  // namespace priamos::bus::radio
