#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// Times of a half-duplex channel on which one station polls several robots: a poll is one frame, its answer
/// another one.
struct SharedChannel {
  Duration turnaround{};  ///< time after its own last byte in which an end cannot receive
  Duration latency{};     ///< of the line, one way, at most, without the time of the bytes
  Duration grace{};       ///< a robot that has not begun so long after it might says nothing
  Duration answer{};      ///< longest frame of a robot
};

/// Of so many polls one at most goes to a robot before its turn, because it has to answer or is driven.
inline constexpr int kAskEvery = 3;

/// Whose turn it is on a shared channel. Robots are polled in turn; one that does not answer is left out for
/// up to kMostSkipped cycles, so that absent robots cost little and come back within a bounded time.
class PollCycle {
 public:
  static constexpr int kMostSkipped = 3;

  /// Robots have the addresses 1 to `robots`, at least one.
  PollCycle(SharedChannel channel, std::uint8_t robots);

  /// Whether the station may talk: to poll, or to send urgent messages.
  bool MayTalk(Time now) const { return !polled_ && now >= free_; }
  /// Chooses the robot to poll next.
  std::uint8_t Next();
  /// The last byte of the poll to `address` leaves at `frame_end`: the robot has the turn from then on.
  void OnPollSent(std::uint8_t address, Time frame_end);
  /// Bytes arrived: somebody talks, and may do so until the turn's end.
  void OnBytes() { heard_ = polled_.has_value(); }
  /// The robot that was polled has answered at `now`.
  void OnAnswer(Time now);
  /// Takes the turn back from a robot that is silent, or whose answer was lost.
  void Step(Time now);
  /// The robot that has the turn.
  std::optional<std::uint8_t> polled() const { return polled_; }

 private:
  struct Robot {
    int missed = 0;   ///< polls in succession without an answer
    int skipped = 0;  ///< cycles for which it is still left out
  };
  void TakeBack(bool answered, Time free);

  SharedChannel channel_;
  std::vector<Robot> robots_;
  std::size_t next_ = 0;
  std::optional<std::uint8_t> polled_;
  Time poll_end_{};
  Time free_{};         ///< the station may talk from then on
  bool heard_ = false;  ///< bytes arrived in this turn
};

/// Longest frames of a shared channel, as times on the line.
struct SharedFrames {
  Duration poll{};    ///< of the station
  Duration urgent{};  ///< of the station, with an emergency stop to one robot
};

/// Worst cases on a channel without bit errors.
struct PollBounds {
  Duration slot{};        ///< from the beginning of a poll to that of the next one
  Duration cycle{};       ///< from one turn of a robot to its next, without urgent messages in between
  Duration asked{};       ///< the same of the one robot that is driven
  Duration urgent{};      ///< frame of the station with an urgent message, until the next one can begin
  Duration urgent_one{};  ///< from the offer of an emergency stop to one robot to its last byte there
  Duration urgent_all{};  ///< the same to every robot, one frame each
  /// `cycle` and `asked` when urgent messages come to all robots at their rates, with their repetitions and
  /// the polls that bring the acknowledgements; nullopt: not bounded within a minute.
  std::optional<Duration> busy_cycle{}, busy_asked{};
};

/// Bounds for `robots` robots. An urgent message is offered at worst just as a poll begins: the poll and the
/// turn that it grants are waited for, nothing else. `tick`: how often each end looks.
PollBounds ComputePollBounds(const SharedChannel& channel, const SharedFrames& frames, std::uint8_t robots,
                             Duration tick);

}  // namespace priamos::bus::radio
