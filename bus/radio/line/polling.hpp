#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// Times of a half-duplex channel on which one station polls several robots.
struct SharedChannel {
  Duration turnaround{};  ///< time after its own last byte in which an end cannot receive
  Duration latency{};     ///< of the line, one way, without the time of the bytes
  Duration grace{};       ///< a robot that has not begun so long after it might says nothing
  Duration turn{};        ///< longest time from a robot's first byte to its last, both as sent
};

/// Turn of one robot on a shared channel: it talks only after a poll addressed to it, and never by itself.
class PolledTurn {
 public:
  explicit PolledTurn(SharedChannel channel) : channel_(channel) {}

  /// The last byte of a poll to this robot arrived at `now`.
  void OnPoll(Time now);
  /// Whether the robot may begin a frame that takes `length` on the line; the first one fixes the turn's end.
  bool MaySend(Time now, Duration length) const;
  /// A frame that MaySend allowed begins at `now`; `over`: it is the last one of the turn.
  void OnSent(Time now, bool over);

 private:
  SharedChannel channel_;
  std::optional<Time> from_;   ///< earliest first byte; none: no turn
  std::optional<Time> began_;  ///< first byte
};

/// The station's side: whose turn it is. Robots are polled in turn; one that does not answer is left out for
/// up to kMostSkipped cycles, so that absent robots cost little and come back within a bounded time.
class PollCycle {
 public:
  static constexpr int kMostSkipped = 7;

  /// Robots have the addresses 1 to `robots`.
  PollCycle(SharedChannel channel, std::uint8_t robots);

  /// Whether the station may talk: to poll, or to send urgent messages.
  bool MayTalk(Time now) const { return !polled_ && now >= free_; }
  /// Chooses the robot to poll next and counts it as polled; call only to send that poll.
  std::uint8_t Next();
  /// The last byte of the poll to `address` leaves at `frame_end`: the robot has the turn from then on.
  void OnPollSent(std::uint8_t address, Time frame_end);
  /// Bytes arrived: somebody talks, and may do so until the turn's end.
  void OnBytes() { heard_ = polled_.has_value(); }
  /// An authentic frame of `address` ended at `now`; `over`: it was the last one of its turn.
  void OnFrame(std::uint8_t address, Time now, bool over);
  /// Takes the turn back from a robot that is silent, or whose "over" was lost.
  void Step(Time now);

 private:
  struct Robot {
    int missed = 0;   ///< polls in succession without an answer
    int skipped = 0;  ///< cycles for which it is still left out
  };
  Robot& At(std::uint8_t address) { return robots_[address - 1U]; }
  void TakeBack(Time free);

  SharedChannel channel_;
  std::vector<Robot> robots_;
  std::size_t next_ = 0;
  std::optional<std::uint8_t> polled_;  ///< the robot that has the turn
  Time poll_end_{};
  Time free_{};          ///< the station may talk from then on
  bool heard_ = false;   ///< bytes arrived in this turn
  bool proven_ = false;  ///< a frame of the polled robot arrived in this turn
};

/// Lengths of the station's frames on the line.
struct StationFrames {
  Duration poll{};    ///< longest frame that ends with a poll
  Duration urgent{};  ///< longest frame with an emergency stop, to one robot
};

/// Worst cases on a channel without bit errors, from the moment of the offer to the last byte at the
/// receiver.
struct PollBounds {
  Duration cycle{};       ///< from one turn of a robot to its next, all robots answering
  Duration urgent_one{};  ///< emergency stop to one robot
  Duration urgent_all{};  ///< emergency stop to every robot, one frame each
};

/// Bounds for `robots` robots. An urgent message is offered at worst just as a poll begins: the poll and the
/// turn that it grants are waited for, nothing else.
PollBounds ComputePollBounds(const SharedChannel& channel, const StationFrames& frames, std::uint8_t robots);

}  // namespace priamos::bus::radio
