#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "test/bus/radio/measurement/numbered_message.hpp"
#include "test/bus/radio/shared/shared_channel.hpp"

namespace priamos::bus::radio {

/// Messages to and from every robot of a SharedWorld at random times, never more often than their rates, and
/// how long each took. Stops go to one robot or to all at once. One robot at a time is driven.
class SharedTraffic {
 public:
  /// What came of the messages of one kind.
  struct Kind {
    std::size_t offered = 0;
    std::size_t late = 0;                      ///< commands that came when they were too old
    std::vector<Duration> latencies{};         ///< of those that came
    std::size_t repeated = 0, disordered = 0;  ///< events that came twice, or not in their order
  };

  SharedTraffic(SharedWorld& world, std::size_t robots, std::uint64_t seed)
      : world_(world), robots_(robots), rng_(Rng::Stream(seed, "traffic")) {}

  /// Runs with new messages, then without, so that all can come.
  void Run(double seconds, double rest_s = 10) {
    world_.Run(seconds, [this] {
      Offer();
      Collect();
    });
    world_.Run(rest_s, [this] { Collect(); });
  }
  /// From now on every robot has a newer pose to send at any time: only the rate of the channel keeps it
  /// back.
  void KeepPosesComing() { poses_always_ = true; }
  /// Of one channel; stops to one robot are kSharedStop, to all kStopToAll.
  Kind& of(std::size_t kind) { return kinds_[kind]; }
  std::size_t timed() const {
    std::size_t sum = 0;
    for (const auto& [kind, k] : kinds_) sum += k.latencies.size();
    return sum;
  }
  static constexpr std::size_t kStopToAll = 100;

 private:
  void Offer() {
    for (std::size_t r = 0; r < robots_; ++r) {
      for (const std::size_t channel : {kSharedPose, kSharedFault, kSharedOrder})
        if (channel == kSharedPose && poses_always_
                ? ToUtime(world_.now) % 20'000 == 0
                : Due(channel * 8 + r, SharedTestChannels()[channel].rate_hz))
          Send(channel, channel, r);
      if (r == driven_ && Due(kSharedDrive * 8 + r, 20)) Send(kSharedDrive, kSharedDrive, r);
    }
    if (Due(70, 0.02)) driven_ = rng_.engine()() % robots_;
    if (!Due(71, 0.05)) return;
    if (rng_.Chance(0.5)) return Send(kSharedStop, kSharedStop, rng_.engine()() % robots_);
    for (std::size_t r = 0; r < robots_; ++r) Send(kStopToAll, kSharedStop, r);
  }
  bool Due(std::size_t what, double rate_hz) {
    const auto wait = [&] { return FromSeconds(rng_.Uniform(1.0, 1.7) / rate_hz); };
    const auto [at, first] = next_.try_emplace(what, world_.now + wait());
    if (first || world_.now < at->second) return false;
    at->second = world_.now + wait();
    return true;
  }
  void Send(std::size_t kind, std::size_t channel, std::size_t robot) {
    LinkEndpoint* const end =
        channel == kSharedPose || channel == kSharedFault ? world_.robot(robot) : &world_.at_station(robot);
    if (end == nullptr) return;
    const std::uint64_t number = channel == kSharedStop ? StopNumber(++stops_) : ++number_;
    if (end->Offer(channel, Numbered((SharedTestChannels()[channel].max_bits + 7) / 8, number), world_.now) !=
        OfferResult::kAccepted)
      return;
    ++kinds_[kind].offered;
    offers_[{channel, number}] = {kind, world_.now};
  }
  /// A number whose bits are among the 14 of a stop that are sent.
  static std::uint64_t StopNumber(std::uint64_t n) { return (n & 0xFF) | (n >> 8 << 10 & 0xFC00); }
  void Collect() {
    for (auto* received : {&world_.up, &world_.down}) {
      for (const SharedWorld::Received& r : *received) Note(r);
      received->clear();
    }
  }
  void Note(const SharedWorld::Received& r) {
    const std::uint64_t number = NumberOf(r.delivery.packed);
    const auto offer = offers_.find({r.delivery.channel, number});
    if (offer == offers_.end()) return;
    Kind& kind = kinds_[offer->second.first];
    const Duration age = r.at - offer->second.second;
    const bool is_event = r.delivery.channel != kSharedPose && r.delivery.channel != kSharedDrive;
    if (is_event && !came_.insert({r.delivery.channel, number}).second) ++kind.repeated;
    auto& last = last_[{r.robot, r.delivery.channel}];
    if (number < last) ++kind.disordered;
    last = std::max(last, number);
    if (r.delivery.channel == kSharedDrive && age > SharedTestChannels()[kSharedDrive].ttl) ++kind.late;
    kind.latencies.push_back(age);
  }

  SharedWorld& world_;
  std::size_t robots_;
  Rng rng_;
  bool poses_always_ = false;
  std::size_t driven_ = 0;
  std::uint64_t number_ = 0, stops_ = 0;
  std::map<std::size_t, Kind> kinds_;
  std::map<std::size_t, Time> next_;
  std::map<std::pair<std::size_t, std::uint64_t>, std::pair<std::size_t, Time>> offers_;
  std::set<std::pair<std::size_t, std::uint64_t>> came_;
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> last_;
};

}  // namespace priamos::bus::radio
