#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "bus/radio/budget.hpp"
#include "numbered_message.hpp"

namespace priamos::bus::radio {

/// Three times the line is offered on both sides: state channels far above their rates, events and commands
/// at theirs.
struct Overload {
  double offered_share = 0;     ///< of the line, each way
  double worst_bound_used = 0;  ///< largest latency of a command or event over its computed bound
  double lowest_floor = 1;      ///< smallest rate of a state channel over its rate_hz
  double worst_queue_age = 0;   ///< over the channel's time-to-live
  std::size_t timed = 0;        ///< commands and events
};

inline std::vector<LinkChannel> OverloadChannels() {
  std::vector<LinkChannel> channels = TestChannels();
  const auto set = [&](std::size_t i, std::uint32_t bytes, double rate_hz, double ttl_s) {
    channels[i].fixed_bits = channels[i].max_bits = 8 * bytes;
    channels[i].rate_hz = rate_hz;
    channels[i].ttl = FromSeconds(ttl_s);
  };
  set(kPoseUp, 10, 5, 0.5);
  set(kEventUp, 200, 1.2, 0);
  set(kSlowUp, 100, 2, 2);
  set(kDriveDown, 5, 20, 0.5);
  set(kStopDown, 4, 0.2, 0);
  set(kEventDown, 150, 1, 0);
  LinkChannel more = channels[kSlowUp];
  more.name = "MORE";
  more.direction = Direction::kDown;
  channels.push_back(more);
  return channels;
}

class OverloadRun {
 public:
  explicit OverloadRun(std::uint64_t seed)
      : pair_(LineConfig{.latency_s = 0}, seed, {.line_delay = Duration(10'000)}),
        table_(OverloadChannels(), false),
        rng_(Rng::Stream(seed, "offers")) {
    pair_.onboard.channels = pair_.offboard.channels = OverloadChannels();
    for (LinkPair::End* end : {&pair_.onboard, &pair_.offboard}) pair_.Start(*end);
    const Budget budget = ComputeBudget(table_, pair_.onboard.options);
    for (const DirectionBudget* d : {&budget.up, &budget.down})
      for (const ChannelBudget& row : d->channels)
        if (row.worst_latency) bound_s_[row.channel] = Seconds(*row.worst_latency);
  }

  Overload Run(double seconds) {
    pair_.Run(1.5);
    next_.assign(table_.size(), pair_.now);
    pair_.each_step = [this] { Step(); };
    pair_.Run(seconds);
    for (std::size_t i = 0; i < table_.size(); ++i)
      if (table_.at(i).channel_class == ChannelClass::kState)
        result_.lowest_floor =
            std::min(result_.lowest_floor, (delivered_[i] + 1) / (seconds * table_.at(i).rate_hz));
    result_.offered_share = std::min(bytes_[Direction::kUp], bytes_[Direction::kDown]) / seconds / 960;
    return result_;
  }

 private:
  void Step() {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const LinkChannel& c = table_.at(i);
      LinkEndpoint& link = c.direction == Direction::kUp ? *pair_.onboard.link : *pair_.offboard.link;
      if (pair_.now >= next_[i]) Offer(i, link);
      if (c.ttl > Duration::zero())
        result_.worst_queue_age =
            std::max(result_.worst_queue_age, Seconds(link.OldestAge(i, pair_.now)) / Seconds(c.ttl));
    }
    Collect(pair_.onboard);
    Collect(pair_.offboard);
  }
  void Offer(std::size_t i, LinkEndpoint& link) {
    const LinkChannel& c = table_.at(i);
    link.Offer(i, NumberedMessage(number_, c.fixed_bits / 8), pair_.now);
    offered_[number_++] = pair_.now;
    bytes_[c.direction] += c.fixed_bits / 8.0;
    const bool state = c.channel_class == ChannelClass::kState;
    next_[i] += FromSeconds(state ? c.fixed_bits / 8.0 / 3000 : rng_.Uniform(1, 1.2) / c.rate_hz);
  }
  void Collect(LinkPair::End& end) {
    for (const LinkPair::Received& r : end.received) {
      const std::size_t i = r.delivery.channel;
      ++delivered_[i];
      if (table_.at(i).channel_class == ChannelClass::kState) continue;
      const double latency_s = Seconds(r.at - offered_.at(NumberOf(r.delivery.packed)));
      result_.worst_bound_used = std::max(result_.worst_bound_used, latency_s / bound_s_.at(i));
      ++result_.timed;
    }
    end.received.clear();
  }

  LinkPair pair_;
  ChannelTable table_;
  Rng rng_;
  Overload result_;
  std::map<std::size_t, double> bound_s_;
  std::vector<Time> next_;
  std::map<std::uint32_t, Time> offered_;
  std::map<std::size_t, int> delivered_;
  std::map<Direction, double> bytes_;
  std::uint32_t number_ = 0;
};

inline Overload MeasureOverload(std::uint64_t seed, double seconds) {
  return OverloadRun(seed).Run(seconds);
}

}  // namespace priamos::bus::radio
