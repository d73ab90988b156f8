#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_selection.hpp"
#include "common/time.hpp"

namespace priamos::bus {

/// Plays a log against a clock that the caller brings: gives the time of the next event and hands out those
/// that are due. Speed, pause, step and seek take effect at the next Play(). Times of recording that run
/// backwards or jump ahead for a single event (damage, joined logs) do not stop it: such an event is played
/// between its neighbours.
class LogPlayer {
 public:
  static constexpr double kFlatOut = 0;  ///< the speed that means: as fast as events can be sent
  using Send = std::function<void(const std::string& channel, const LogEvent& event)>;

  /// Reads through the whole log once.
  LogPlayer(LogReader reader, LogSelection selection);

  void SetSpeed(double speed, Time now);
  double speed() const { return speed_; }
  void SetLoop(bool loop) { loop_ = loop; }
  void Pause(bool paused, Time now);
  bool paused() const { return paused_; }
  /// Sends the next event at the next Play(), whatever its time; pauses.
  void Step(Time now);
  /// Moves the playback to `position` since the log's beginning, cut to the log's length.
  void Seek(Duration position, Time now);

  /// Time of recording of the first event.
  Time begin() const;
  Duration position() const;
  Duration length() const;
  std::size_t events() const { return index_.size(); }
  std::uint64_t rounds() const { return rounds_; }  ///< times the end was reached while looping
  std::uint64_t skipped_bytes() const { return reader_.skipped_bytes(); }
  bool done() const { return next_ >= index_.size(); }

  /// Time at which the next event is due; Time::max() while paused or at the end.
  Time NextDue() const;
  /// Sends the events that are due at `now`, at most `at_most`. Returns their number.
  int Play(Time now, const Send& send, int at_most = 1000);

 private:
  struct Entry {
    std::int64_t utime;  ///< made to run forward
    std::size_t offset;
  };
  void Anchor(Time now);
  void SendNext(const Send& send);
  void BeginAgain(Time now);

  LogReader reader_;
  LogSelection selection_;
  std::vector<Entry> index_;
  std::size_t next_ = 0;
  double speed_ = 1;
  bool loop_ = false, paused_ = false, anchored_ = false;
  int steps_ = 0;
  std::uint64_t rounds_ = 0;
  Time anchor_{};                  ///< this moment ...
  std::int64_t anchor_utime_ = 0;  ///< ... is this time of the log
};

}  // namespace priamos::bus
