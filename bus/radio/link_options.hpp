#pragma once

#include <cstddef>
#include <cstdint>

#include "bus/radio/line/duty_cycle.hpp"
#include "bus/radio/line/turn_taking.hpp"
#include "common/input/section_place.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// How an end uses the line.
struct LinkOptions {
  double bytes_per_s = 960;            ///< what the line carries, or the radio if that is slower
  int ahead_bytes = 2;                 ///< bytes written ahead of the line, beside the byte being sent
  std::size_t max_bundle_bytes = 120;  ///< bytes of a bundle of several messages; a longer message goes alone
  Duration keep_alive{250'000};        ///< longest silence of this end
  Duration silence{1'500'000};         ///< the link is down after so long without a frame
  Duration ageing{1'000'000};          ///< waiting time for which a message gains one priority level
  HalfDuplex half_duplex{};  ///< turns of a radio with one channel; by default there are two directions
  /// Delay of both directions of the line together, which the budget reckons with.
  Duration line_delay{100'000};
  bool datagrams = false;  ///< a frame goes whole, in one datagram, whose head counts as sent
  /// Time on air of a packet beside its frame: preamble and header. Above 0 the datagrams are packets of a
  /// radio: a packet occupies the air until it has ended, also for what is urgent.
  Duration packet_overhead{};
  /// Largest packet of the radio, a frame in it whole; 0: as long as any frame.
  std::size_t packet_bytes = 0;
  /// Share of the time, in any window of this length, that each end may be on the air with its packets.
  DutyCycle duty{};

  /// Robots on the channel, each with its address and key, which a station polls; 0: a link of two ends.
  std::uint8_t robots = 0;
  /// Of the robot of this end, 1 to `robots`; 0 on a link of two ends.
  std::uint8_t address = 0;
  /// A polled robot begins at most so late; what its process needs to notice the poll.
  Duration grace{5'000};

  SectionPlace place{};  ///< where they are configured, for errors

  /// Whether a frame goes in a packet of a radio, which nothing can cut off.
  bool packets() const { return datagrams && packet_overhead > Duration::zero(); }
  /// Whether a frame leaves at the time it is handed over: a datagram of an IP link.
  bool instant() const { return datagrams && !packets(); }
  /// Bytes that a datagram takes on the line beside its frame; 0 where frames are no datagrams.
  std::size_t HeadBytes() const;
  /// The turns of an end on the radio. A receiver hears nothing of a packet before it has ended, and must not
  /// take the turn meanwhile.
  HalfDuplex Turns(bool onboard) const;
};

/// Time in which the other end, whose frames have codes of `code_bytes`, can send half of the frames that an
/// echo of `echo_bytes` tells apart: the other half is for a line that grows slower. One that it cannot
/// complete would cost the whole frame, also an emergency stop.
Duration EchoReach(const LinkOptions& options, std::size_t echo_bytes, std::size_t code_bytes);

}  // namespace priamos::bus::radio
