#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bus/radio/line/polling.hpp"
#include "bus/radio/link.hpp"

namespace priamos::bus::radio {

/// The turns of one radio channel that a station and several robots share. The station polls: a robot sends
/// one frame in answer to a frame addressed to it, and is silent otherwise. Urgent messages go before the
/// next poll, one frame for each robot that has any, and again before each poll until they are acknowledged.
/// A robot that was sent one is polled next; later, and when it is driven, before its turn as kAskEvery says.
/// Pure: time is an argument, bytes in and bytes out.
///
/// It grants the turns and knows nothing of what the ends send; each end is a LinkEndpoint with the address
/// of its robot in its options, a key and a memory of its own.
class Station {
 public:
  /// `ends`: offboard ends of the robots 1, 2, ... in this order, which must outlive the station.
  Station(SharedChannel channel, std::vector<LinkEndpoint*> ends);

  /// Notes that what had arrived by `now` was read: silence is known until then.
  void OnLook(Time now) { looked_ = now; }
  /// The bytes that may be written to the line now. Call it every 1 or 2 ms.
  std::vector<std::byte> Step(Time now);
  /// Hands the bytes from the line to every end; `deliver` gets the index of the robot, from 0.
  void Receive(std::span<const std::byte> bytes, Time now,
               const std::function<void(std::size_t robot, Delivery)>& deliver);

 private:
  struct Grant {
    std::size_t robot;
    bool poll;
  };
  /// What a robot got since the last poll, beside that, and the polls since it has not answered an urgent
  /// message.
  struct Urgency {
    bool spoken = false;     ///< it was sent an urgent message
    bool fruitless = false;  ///< its end had none to send after all
    int asks = 0;
  };
  bool Choose(Time now);
  std::size_t FirstToSpeak(Time now) const;
  bool MaySpeak(std::size_t robot, Time now) const;
  std::size_t NextPoll(Time now);
  std::optional<std::size_t> FindAsked(Time now);
  void OnFrameSent(Time now);

  std::vector<LinkEndpoint*> ends_;
  std::vector<Urgency> urgency_;
  PollCycle cycle_;
  std::optional<Time> looked_;    ///< what had arrived by then was read
  std::optional<Grant> granted_;  ///< the end that sends a frame now
  Time line_free_{};              ///< when the last byte of the station has left
  std::size_t last_asked_ = 0;    ///< robot that was polled before its turn last
  int regular_ = 0;               ///< polls since the last one before a robot's turn
};

}  // namespace priamos::bus::radio
