#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "bus/radio/line/line.hpp"

namespace priamos::bus::radio {

/// One radio channel that a station and several robots share, in simulated time: everybody hears everybody,
/// nobody while sending, and of two that send at once nobody is understood.
class SharedLine {
 public:
  /// Channel of `sides` modems: 0 is the station's, 1, 2, ... those of the robots. It is half-duplex,
  /// whatever `config` says; errors are drawn for each listener.
  SharedLine(const LineConfig& config, std::size_t sides, std::uint64_t seed, Time start);

  /// Sends bytes of a modem; calls must come in the order of `now`.
  void Write(std::size_t side, std::span<const std::byte> bytes, Time now);
  /// What a modem has heard until `now`.
  std::vector<std::byte> Read(std::size_t side, Time now);
  /// Time at which the byte that a modem was given last has left its port.
  Time free_at(std::size_t side) const;
  /// Time at which the next byte can be read; Time::max() when none is under way.
  Time next_arrival() const;
  std::size_t sides() const { return lines_.size(); }

 private:
  std::shared_ptr<SharedAir> air_;
  std::vector<std::vector<std::unique_ptr<Line>>> lines_;  ///< by sender and receiver; none to itself
};

}  // namespace priamos::bus::radio
