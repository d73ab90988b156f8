#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "shipped_link.hpp"

namespace priamos::bus::radio {

/// What becomes of an operator's drive commands. One is obeyed when the robot's end delivers it, which it
/// does only within its time-to-live. Every command that was offered counts, also one that a newer one
/// replaced before its turn: to the operator it makes no difference why the robot did not do what he did.
///
/// An emergency stop takes the line until it is acknowledged. A command that is the newest meanwhile waits
/// for it, and a newer one may replace it: the base stands, and would refuse it.
struct Obeyed {
  std::size_t offered = 0;
  std::size_t stops = 0;
  std::size_t displaced = 0;       ///< not obeyed, and the newest while a stop was not acknowledged
  std::size_t most_displaced = 0;  ///< by one stop
  double longest_stop_s = 0;       ///< from the offer of a stop to its acknowledgement
  std::vector<double> took_s;      ///< from the offer to the delivery, of those obeyed
  double longest_gap_s = 0;        ///< between two that were obeyed
  double share() const { return static_cast<double>(took_s.size()) / static_cast<double>(offered); }
  /// Of the commands that no stop displaced.
  double share_without_stops() const {
    return static_cast<double>(took_s.size()) / static_cast<double>(offered - displaced);
  }
  double quantile_s(double part) const {
    std::vector<double> sorted = took_s;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0
                          : sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
  }
};

/// How the shipped link is used while somebody drives.
struct DriveConditions {
  double up_s = 0, down_s = 0;  ///< delay of each direction of the line
  double load = 1;      ///< offers of all other channels, of their rates, each message as large as it can be
  double jitter_s = 0;  ///< a command is offered by up to so much later than its 1/20 s
  double stops_hz = 0;  ///< emergency stops
  double seconds = 60;
};

/// Twenty drive commands a second over the shipped link, all on-request channels listened to.
class DriveRun {
 public:
  DriveRun(const DriveConditions& conditions, std::uint64_t seed)
      : with_(conditions), rng_(Rng::Stream(seed, "offers")), pair_(LineOf(conditions), seed) {
    UseShippedLink(pair_);
    drive_ = ChannelOf(pair_, "DRIVE_COMMAND");
    stop_ = ChannelOf(pair_, "ESTOP");
    const auto& channels = pair_.onboard.channels;
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (channels[i].on_request) pair_.offboard.link->Listen(i, true);
    pair_.Run(1.5);
    next_.assign(channels.size(), pair_.now);
    start_ = next_drive_ = last_ = pair_.now;
  }

  Obeyed Run() {
    pair_.each_step = [this] { Step(); };
    pair_.Run(with_.seconds);
    CountDisplaced();
    return result_;
  }

 private:
  static LineConfig LineOf(const DriveConditions& with) {
    LineConfig line{.latency_s = 0};
    line.delays = {{"a_to_b", 0, 1e6, with.up_s, with.up_s}, {"b_to_a", 0, 1e6, with.down_s, with.down_s}};
    return line;
  }
  void Step() {
    EndStop();
    if (pair_.now >= next_drive_) Drive();
    const auto& channels = pair_.onboard.channels;
    for (std::size_t i = 0; i < channels.size(); ++i)
      if (i != drive_ && pair_.now >= next_[i]) Offer(i, channels[i]);
    for (const LinkPair::Received& r : pair_.onboard.received)
      if (r.delivery.channel == drive_) Take(r);
    pair_.onboard.received.clear();
    pair_.offboard.received.clear();
  }
  void Drive() {
    const std::size_t bytes = pair_.offboard.channels[drive_].max_bits / 8;
    pair_.offboard.link->Offer(drive_, NumberedMessage(static_cast<std::uint32_t>(offered_.size()), bytes),
                               pair_.now);
    offered_.push_back(pair_.now);
    obeyed_.push_back(false);
    ++result_.offered;
    next_drive_ = start_ + static_cast<std::int64_t>(offered_.size()) * Duration(50'000) +
                  FromSeconds(rng_.Uniform(0, with_.jitter_s));
  }
  void Offer(std::size_t i, const LinkChannel& c) {
    const double rate_hz = c.urgent ? with_.stops_hz : with_.load * c.rate_hz * c.max_keys;
    next_[i] = rate_hz > 0 ? pair_.now + FromSeconds(rng_.Uniform(1, 1.2) / rate_hz) : Time::max();
    if (rate_hz <= 0) return;
    if (i == stop_) stops_.push_back({pair_.now, Time::max()});
    LinkPair::End& end = c.direction == Direction::kUp ? pair_.onboard : pair_.offboard;
    end.link->Offer(i, std::vector<std::byte>(c.max_bits / 8, std::byte{7}), pair_.now,
                    std::to_string(rng_.Below(static_cast<std::uint64_t>(c.max_keys))));
  }
  void Take(const LinkPair::Received& r) {
    const std::size_t number = NumberOf(r.delivery.packed);
    obeyed_.at(number) = true;
    result_.took_s.push_back(Seconds(r.at - offered_.at(number)));
    result_.longest_gap_s = std::max(result_.longest_gap_s, Seconds(r.at - last_));
    last_ = r.at;
  }

  /// Notes that all stops so far are acknowledged.
  void EndStop() {
    if (stops_.empty() || stops_.back().end != Time::max()) return;
    if (pair_.offboard.link->sent(stop_).sent == stops_.size()) stops_.back().end = pair_.now;
  }
  void CountDisplaced() {
    result_.stops = stops_.size();
    for (const Stop& stop : stops_) {
      std::size_t displaced = 0;
      for (std::size_t i = 0; i + 1 < offered_.size(); ++i)
        displaced += !obeyed_[i] && offered_[i] <= stop.end && offered_[i + 1] > stop.begin ? 1U : 0U;
      result_.displaced += displaced;
      result_.most_displaced = std::max(result_.most_displaced, displaced);
      if (stop.end != Time::max())
        result_.longest_stop_s = std::max(result_.longest_stop_s, Seconds(stop.end - stop.begin));
    }
  }

  struct Stop {
    Time begin, end;
  };
  DriveConditions with_;
  Rng rng_;
  LinkPair pair_;
  std::size_t drive_ = 0, stop_ = 0;
  Time start_{}, next_drive_{}, last_{};
  std::vector<Time> next_, offered_;
  std::vector<bool> obeyed_;
  std::vector<Stop> stops_;
  Obeyed result_;
};

}  // namespace priamos::bus::radio
