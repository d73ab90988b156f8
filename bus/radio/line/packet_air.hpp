#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "bus/radio/line/line.hpp"
#include "common/random.hpp"
#include "common/time.hpp"

namespace priamos::bus::radio {

/// What two packet radios and the air between them are like.
struct PacketAirConfig {
  double bytes_per_s = 684;     ///< on the air
  double overhead_s = 0.02;     ///< time on air of a packet beside its bytes: preamble and header
  std::size_t mtu_bytes = 255;  ///< a longer packet is not sent
  double latency_s = 0.005;     ///< from the end of a packet to its bytes at the receiver
  double loss = 0;              ///< probability that a packet is lost
  bool half_duplex = false;     ///< one channel: of packets that overlap none is heard
  std::vector<LineCut> cuts{};  ///< times in which nothing is heard
};

/// Two packet radios in simulated time. A packet arrives whole, or not at all; a radio sends one after the
/// other.
class PacketAir {
 public:
  PacketAir(PacketAirConfig config, Rng rng, Time start);

  /// Hands a packet to the radio of a side, 0 or 1; calls must come in the order of `now`.
  void Send(std::size_t side, std::vector<std::byte> packet, Time now);
  /// The packets that a side has received until `now`.
  std::vector<std::vector<std::byte>> Receive(std::size_t side, Time now);
  /// When a side's radio has sent all it was given.
  Time free_at(std::size_t side) const { return free_at_[side]; }
  /// When the next packet can be received; Time::max() when none is under way.
  Time next_arrival() const;
  /// Packets that met one of the other side.
  std::size_t collisions() const { return collisions_; }

 private:
  struct Packet {
    Time from, to;
    std::vector<std::byte> bytes;
    bool lost;
  };
  bool IsCut(Time from, Time to) const;
  void Collide(std::size_t side, Packet& packet);

  PacketAirConfig config_;
  Rng rng_;
  Time start_;
  Time free_at_[2];
  std::deque<Packet> on_air_[2];  ///< by sender, in order
  std::size_t collisions_ = 0;
};

}  // namespace priamos::bus::radio
