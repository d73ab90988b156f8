#pragma once

#include <functional>
#include <optional>

#include "bus/radio/budget_frames.hpp"
#include "bus/radio/channels/frames_ahead.hpp"

/// Response times of the channels of one direction. The method and its sources: budget.hpp.
namespace priamos::bus::radio {

/// Analysis of all channels of one direction: what arrives before a message, and how long that takes.
class DirectionAnalysis : public DirectionFrames {
 public:
  /// Analysis of the channels of one direction; `table` must outlive it.
  DirectionAnalysis(const ChannelTable& table, const LinkOptions& options, Direction direction);

  /// Computes the latencies of loads(). Urgent events of both directions are repeated and acknowledged at
  /// once, over a line that delays both directions together by `line_delay_s`.
  void Solve(const DirectionAnalysis& other, double line_delay_s);
  /// Longest time of a shared channel that is `turn` without urgent messages, when these come at their rates;
  /// nullopt: not bounded within a minute.
  std::optional<Duration> BesideUrgent(Duration turn) const;
  /// Time within which a message of the channel whose age is bounded has left that is offered at any moment,
  /// beside urgent events, if it is `within_s` without them; nullopt: not bounded within a minute.
  std::optional<double> FreshBesideUrgent(double within_s) const;

 private:
  /// A message that waits.
  struct Waiting {
    double entries = 1;
    double entry_bits = 0;  ///< of its largest entry
    double bits = 0;        ///< of all of them
  };

  double UrgentIn(double window_s, const ChannelLoad& load) const;
  bool GoesBefore(const ChannelLoad& other, const ChannelLoad& load) const;
  double Urgent(const ChannelLoad& load) const;
  double Ordinary(const ChannelLoad& load) const;
  double Ordinary(const ChannelLoad& load, const Waiting& waiting) const;
  double ShortFrames(double window_s, const ChannelLoad& load) const;
  double BlockingSeconds(const ChannelLoad& load) const;
  bool IsFreshBeside(const ChannelLoad& other, const ChannelLoad& load) const;
  double OrdinaryIn(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  static Ahead OwnAhead(double window_s, const ChannelLoad& load, const Waiting& waiting);
  double FramesBefore(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  double BitsBefore(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  double PolledUrgent(const ChannelLoad& load) const;
  double CrowdedOutSeconds(const ChannelLoad& load) const;
  double PolledUrgentIn(double window_s) const;
  double PolledIn(double window_s, const ChannelLoad& load, const Waiting& waiting) const;
  double Converge(const std::function<double(double window_s)>& latency) const;

  double ageing_s_;
  bool solved_once_ = false;
};

}  // namespace priamos::bus::radio
