#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/channels/frames_ahead.hpp"
#include "bus/radio/line/polling.hpp"
#include "bus/radio/link_options.hpp"

/// Response times of the channels of one direction. The method and its sources: budget.hpp.
namespace priamos::bus::radio {

/// One channel as a load on its direction.
struct ChannelLoad {
  std::size_t channel = 0;
  bool urgent = false;
  bool newest_only = false;  ///< a newer message replaces one that waits
  bool command = false;
  bool repeated = false;  ///< an urgent event: repeated until it is acknowledged
  int priority = 0;
  double period_s = 0;
  double burst = 1;
  double keys = 1;
  double entries = 1;      ///< number of entries per message
  double entry_bits = 0;   ///< bits of the largest entry
  double bits = 0;         ///< bits of all entries of a message
  double single_bits = 0;  ///< bits of a message of one entry, if that can be longer; else 0
  double latency_s = std::numeric_limits<double>::infinity();

  /// Number of messages that can come in a window of this length.
  double Arrivals(double window_s) const;
  /// Largest number of messages of the same channel ahead of one that waits for `window_s`.
  double OwnBefore(double window_s) const;
};

/// Analysis of all channels of one direction.
class DirectionAnalysis {
 public:
  /// Analysis of the channels of one direction; `table` must outlive it.
  DirectionAnalysis(const ChannelTable& table, const LinkOptions& options, Direction direction);

  /// Counts from now on with the polls of a shared channel: one frame of this direction per turn of a robot.
  void SetPolled(const PollBounds& bounds, int robots);
  /// Computes the latencies of loads(). Urgent events of both directions are repeated and acknowledged at
  /// once, over a line that delays both directions together by `line_delay_s`.
  void Solve(const DirectionAnalysis& other, double line_delay_s);
  const std::vector<ChannelLoad>& loads() const { return loads_; }
  /// Guaranteed share of the line for this direction, 0..1.
  double share() const { return duty_.rate() * turn_s_ / (turn_s_ + gap_s_); }
  /// Load of the acknowledgements.
  double ControlBytesPerSecond() const;
  /// Load of a channel at its rate.
  double BytesPerSecond(const ChannelLoad& load) const;
  /// Time from the offer of a message that is the next to go, to its last byte at the receiver: it waits for
  /// the longest frame (half-duplex: and turn), and no emergency stop comes in between.
  double NextSeconds(const ChannelLoad& load) const;
  /// Longest time of a shared channel that is `turn` without urgent messages, when these come at their rates;
  /// nullopt: not bounded within a minute.
  std::optional<Duration> BesideUrgent(Duration turn) const;
  /// Longest time from the end of a frame to the end of the next one.
  double SilenceSeconds() const;
  /// Time on air that urgent frames take at most beyond what is paid for: with bursts of all of them, and an
  /// ordinary frame before.
  double CreditSeconds() const;
  /// Bytes of the longest frame, with the whole counter, as a packet must hold it.
  std::size_t LongestFrameBytes() const { return longest_bytes_; }
  /// The same as a time on the line, with the delimiter that leads after silence.
  Duration LongestFrameTime() const;
  /// Time on the line of the longest frame with an urgent event; 0 without such a channel.
  double UrgentFrameSeconds() const;
  /// Bytes of the smallest bundle that always has room for a message beside acknowledgements.
  std::size_t SmallestBundleBytes() const;
  /// Time by which a byte may be handed over before it leaves; of a packet, before all of it has left.
  double AheadSeconds() const;

 private:
  /// A message that waits.
  struct Waiting {
    double entries = 1;
    double entry_bits = 0;  ///< of its largest entry
    double bits = 0;        ///< of all of them
  };

  double AnswerSeconds() const;
  double OverBits() const;
  double AckFrameSeconds() const;
  double RepeatedFrameSeconds(double bits) const;
  double AllFramesSeconds(const ChannelLoad& load) const;
  double UrgentIn(double window_s, const ChannelLoad& load) const;
  ChannelLoad LoadOf(std::size_t index) const;
  double ControlBits() const;
  double ControlBitsIn(double window_s) const;
  void ConfineTo(double bundle_bytes, double& largest_bytes);
  void ShareTheAir(const LinkOptions& options);
  double InTurns(double work_s) const;
  double FrameSeconds(double bits) const;
  bool GoesBefore(const ChannelLoad& other, const ChannelLoad& load) const;
  double Urgent(const ChannelLoad& load) const;
  double Ordinary(const ChannelLoad& load) const;
  double Ordinary(const ChannelLoad& load, const Waiting& waiting) const;
  double OrdinaryIn(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  static Ahead OwnAhead(double window_s, const ChannelLoad& load, const Waiting& waiting);
  double FramesBefore(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  double BitsBefore(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  double ControlEntriesIn(double window_s) const;
  double PolledUrgent(const ChannelLoad& load) const;
  double CrowdedOutSeconds(const ChannelLoad& load) const;
  double PolledUrgentIn(double window_s) const;
  double PolledIn(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  double Converge(const std::function<double(double window_s)>& latency) const;

  const ChannelTable& table_;
  Direction direction_;
  double byte_s_;
  DutyCycle duty_;
  bool datagrams_;
  bool packets_;  ///< an urgent frame waits for the end of the one on the air
  double ageing_s_;
  std::size_t frame_bytes_;  ///< bytes of a frame besides its bundle
  double ahead_s_;
  double keep_alive_s_;
  double control_bits_ = 0;
  double bundle_bits_ = 0;    ///< of a bundle of several messages
  double capacity_bits_ = 0;  ///< the same without acknowledgements
  double frame_s_ = 0;
  std::size_t longest_bytes_ = 0;
  double largest_bits_ = 0;  ///< of an entry of a message
  int robots_ = 0;           ///< on a shared channel; 0: a link of two ends
  PollBounds polled_{};
  double turn_s_ = 1;  ///< length of a turn; without turns 1, with gap_s_ = 0
  double gap_s_ = 0;
  double repeat_s_ = 0;                ///< time until an urgent event of this direction is acknowledged
  std::vector<ChannelLoad> answered_;  ///< urgent events of the other direction
  double overhead_ = 1;
  bool solved_once_ = false;
  std::vector<ChannelLoad> loads_;
};

}  // namespace priamos::bus::radio
