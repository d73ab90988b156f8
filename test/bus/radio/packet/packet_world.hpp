#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bus/radio/line/packet_air.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {

/// A packet radio, and what its channels may ask of it.
struct PacketRadio {
  std::string name;
  LinkOptions options;
  double hours;                                 ///< a run of so long offers enough of every channel
  double unit_s;                                ///< mean time between the messages of the slowest channel
  Duration time_to_live = Duration(3'000'000);  ///< of a command
};

/// One channel in turns and one for each direction at LoRa's spreading factor 7, a fast one in turns, and one
/// that may send for a tenth of the time.
std::vector<PacketRadio> PacketRadios();
PacketRadio DutyCycleRadio();

/// Channels of all classes that send a message per 1 to 1.6 `unit_s`; up to 40 bytes, fixed ones 20.
std::vector<LinkChannel> PacketChannels(double unit_s, Duration time_to_live);

/// Two ends and the air between them, in simulated time: every message is timed, every promise that is broken
/// counted.
class PacketWorld {
 public:
  PacketWorld(const PacketRadio& radio, double loss, std::uint64_t seed);

  /// With `offer` every channel sends.
  void Run(double seconds, bool offer);
  const std::vector<LinkChannel>& channels() const { return channels_; }
  std::size_t collisions() const { return air_.collisions(); }
  /// Largest share of a window of this length that one end was on the air.
  double LargestShare(Duration window) const;

  std::map<std::size_t, std::vector<Duration>> latencies;  ///< by channel, without the latency of the air
  std::map<std::size_t, std::size_t> offered, received;    ///< messages by channel
  std::size_t longest_packet = 0;                          ///< bytes
  std::size_t packets = 0;
  std::size_t overlaps = 0;    ///< packets given to a radio that was still sending
  std::size_t refused = 0;     ///< offers
  std::size_t torn = 0;        ///< frames left half sent
  std::size_t disordered = 0;  ///< events that came twice or in another order
  std::size_t late = 0;        ///< commands older than their time-to-live

 private:
  struct End {
    explicit End(Direction direction) : outgoing(direction) {}
    Direction outgoing;
    MemoryStore store;
    std::unique_ptr<LinkEndpoint> link;
    std::vector<std::pair<Time, Time>> on_air;  ///< its packets
  };

  void Offer();
  void Send(std::size_t side);
  void Transmit(std::size_t side, std::vector<std::byte> frame);
  void Receive(std::size_t side);
  void Note(const Delivery& delivery);
  void NoteEvent(const Delivery& delivery);

  PacketRadio radio_;
  Rng rng_;
  PacketAir air_;
  Time now_;
  std::vector<LinkChannel> channels_;
  std::array<End, 2> ends_{End(Direction::kUp), End(Direction::kDown)};
  std::map<std::size_t, Time> next_;
  std::map<std::size_t, std::vector<Time>> offered_at_;
};

}  // namespace priamos::bus::radio
