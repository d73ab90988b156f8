#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/random.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// An interval in which the line carries nothing, in seconds after its start.
struct LineCut {
  double from_s = 0;
  double to_s = 0;
  void Describe(Archive& a);
};

/// An addition to the delay of one direction or both, in an interval in seconds after the start of the line.
/// It goes evenly from `first_s` to `last_s`: the same twice is a step, 0 and more is a ramp, the length of
/// the interval and 0 is a stall that ends with the release of everything that was held.
struct LineDelay {
  std::string way = "both";  ///< "a_to_b", "b_to_a" or "both"
  double from_s = 0;
  double to_s = 0;
  double first_s = 0;  ///< addition to a byte that leaves at from_s
  double last_s = 0;   ///< addition to one that leaves at to_s
  void Describe(Archive& a);
};

/// Delays, errors and losses of a serial line or a radio modem.
struct LineConfig {
  int baud = 9600;                   ///< 10 bits per byte: start, 8 data, stop
  double air_rate_bytes_s = 0;       ///< what the radio itself carries; 0: as much as the port
  double latency_s = 0.005;          ///< time from the end of a byte at the sender to its end at the receiver
  double jitter_s = 0;               ///< largest addition to the latency, uniform; bytes keep their order
  double bit_error_rate = 0;         ///< probability per bit, all 10 of a byte
  double burst_rate_hz = 0;          ///< error bursts per second, Poisson
  double burst_length_s = 0.02;      ///< length of one burst
  double burst_error_rate = 0.3;     ///< bit error rate inside a burst
  double duplicate_probability = 0;  ///< probability that a byte arrives twice
  bool half_duplex = false;          ///< a modem receives nothing while it sends
  double turnaround_s = 0.02;        ///< time after sending in which a modem receives nothing either
  std::vector<LineCut> cuts{};       ///< in order of time
  std::vector<LineDelay> delays{};   ///< those of one time add up
  void Describe(Archive& a);
};

/// The times at which the modems of a half-duplex radio send and cannot receive.
class SharedAir {
 public:
  explicit SharedAir(double turnaround_s, std::size_t sides = 2)
      : turnaround_ns_(static_cast<std::int64_t>(turnaround_s * 1e9)), spans_(sides) {}
  void Sends(int side, std::int64_t from_ns, std::int64_t to_ns);
  bool IsDeaf(int side, std::int64_t from_ns, std::int64_t to_ns) const;
  /// Whether somebody else than these two sides sends.
  bool IsJammed(int sender, int receiver, std::int64_t from_ns, std::int64_t to_ns) const;

 private:
  struct Span {
    std::int64_t from_ns, to_ns;
  };
  std::int64_t turnaround_ns_;
  std::vector<std::deque<Span>> spans_;
};

/// One direction of a serial line in simulated time. Bytes leave one after the other at the baud rate,
/// whenever they were written; bytes written too early wait, as in a tty's buffer. A radio with a lower
/// air rate keeps what it cannot send yet. A flipped start bit loses the byte, a flipped stop bit makes it 0
/// (what a Linux tty delivers for a framing error).
class Line {
 public:
  Line(const LineConfig& config, Rng rng, Time start);
  /// `side` sends into this line: 0 is a to b, 1 is b to a. On a half-duplex radio both share the air.
  Line(const LineConfig& config, Rng rng, Time start, std::shared_ptr<SharedAir> air, int side);
  /// The same on an air of more than two sides, as `receiver` hears it.
  Line(const LineConfig& config, Rng rng, Time start, std::shared_ptr<SharedAir> air, int side, int receiver);

  /// Sends bytes; calls must come in the order of `now`.
  void Write(std::span<const std::byte> bytes, Time now);
  /// Bytes that have arrived until `now`.
  std::vector<std::byte> Read(Time now);
  /// Time at which the byte written last has left the port.
  Time free_at() const { return Time(Duration(free_at_ns_ / 1000)); }
  /// Time at which the byte written last has left the radio: the age of the backlog.
  Time sent_at() const { return Time(Duration(std::max(free_at_ns_, air_free_at_ns_) / 1000)); }
  /// Time at which the next byte can be read; Time::max() when none is under way.
  Time next_arrival() const;

 private:
  struct Arrival {
    std::int64_t at_ns;
    std::byte byte;
  };
  void Transmit(std::byte byte, std::int64_t end_ns);
  bool Cut(std::int64_t at_ns);
  double BitErrorRate(std::int64_t at_ns);
  std::int64_t AddedDelay(std::int64_t at_ns) const;
  void Arrive(std::byte byte, std::int64_t end_ns);

  LineConfig config_;
  Rng rng_;
  std::int64_t start_ns_;
  std::int64_t byte_ns_;
  std::int64_t air_byte_ns_;  ///< 0: the air is as fast as the port
  std::int64_t free_at_ns_;
  std::int64_t air_free_at_ns_;
  std::int64_t last_arrival_ns_;
  std::int64_t burst_start_ns_ = std::numeric_limits<std::int64_t>::max();
  std::shared_ptr<SharedAir> air_;
  int side_ = 0;
  int receiver_ = 1;
  std::size_t next_cut_ = 0;
  std::deque<Arrival> arrivals_;
};

/// Both directions of one line, a to b and b to a.
struct LinePair {
  LinePair(const LineConfig& config, Rng rng_a, Rng rng_b, Time start);
  std::shared_ptr<SharedAir> air;
  Line a_to_b, b_to_a;
};

}  // namespace priamos::bus::radio
