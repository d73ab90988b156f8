#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shipped_link.hpp"

namespace priamos::bus::radio {

/// Times from the end of a blackout to the arrival of the first POSE that was offered after it, in s.
struct FirstPoses {
  std::vector<double> after_s;
  double worst_s() const { return *std::max_element(after_s.begin(), after_s.end()); }
  double ShareWithin(double limit_s) const {
    const auto n = std::count_if(after_s.begin(), after_s.end(), [&](double s) { return s <= limit_s; });
    return static_cast<double>(n) / static_cast<double>(after_s.size());
  }
};

/// The shipped link in blackouts of 0.05 to 8 s, up to 2.3 s apart. All other channels are offered their
/// `load` times their rates, each message as large as it can be; none of those from the robot that can exceed
/// `longest_bits`.
class FirstPoseRun {
 public:
  FirstPoseRun(std::uint64_t seed, bool up, bool down, double load,
               std::uint32_t longest_bits = std::numeric_limits<std::uint32_t>::max())
      : up_dark_(up),
        down_dark_(down),
        load_(load),
        longest_bits_(longest_bits),
        rng_(Rng::Stream(seed, "first pose")),
        pair_({}, seed) {
    UseShippedLink(pair_);
    pair_.each_step = [this] { Step(); };
    pair_.line_cut = [this](bool up_line) { return Dark() && (up_line ? up_dark_ : down_dark_); };
  }

  FirstPoses Run(std::size_t returns) {
    while (result_.after_s.size() < returns) pair_.StepOnce();
    return result_;
  }

 private:
  double now_s() const { return Seconds(pair_.now - start_); }
  bool Dark() const { return now_s() >= from_s_ && now_s() < to_s_; }

  void Step() {
    const auto& channels = pair_.onboard.channels;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      const LinkChannel& c = channels[i];
      if (c.name == "POSE") OfferPose(i);
      const bool offered = c.name != "POSE" && !c.urgent && !c.on_request;
      if (offered && rng_.Uniform(0, 1) < 0.001 * load_ * c.rate_hz * c.max_keys) Offer(c, i);
    }
    std::erase_if(pair_.offboard.received, [&](const LinkPair::Received& r) { return Take(r), true; });
    pair_.onboard.received.clear();
  }
  void OfferPose(std::size_t channel) {
    if (ToUtime(pair_.now) % 20'000 != 0) return;
    pose_ = channel;
    pair_.onboard.link->Offer(
        channel, NumberedMessage(number_++, pair_.onboard.channels[channel].max_bits / 8), pair_.now);
    offered_s_.push_back(now_s());
  }
  void Offer(const LinkChannel& c, std::size_t channel) {
    if (c.direction == Direction::kUp && c.max_bits > longest_bits_) return;
    LinkPair::End& end = c.direction == Direction::kUp ? pair_.onboard : pair_.offboard;
    const std::string key = c.max_keys > 1 ? fmt::format("{:.0f}", rng_.Uniform(0, c.max_keys - 1)) : "";
    end.link->Offer(channel, std::vector<std::byte>(c.max_bits / 8, std::byte{7}), pair_.now, key);
  }
  void Take(const LinkPair::Received& r) {
    if (r.delivery.channel != pose_ || now_s() < to_s_) return;
    if (offered_s_.at(NumberOf(r.delivery.packed)) < to_s_) return;
    result_.after_s.push_back(now_s() - to_s_);
    from_s_ = now_s() + rng_.Uniform(0.3, 2.3);
    to_s_ = from_s_ + 0.05 * std::pow(160, rng_.Uniform(0, 1));
  }

  bool up_dark_, down_dark_;
  double load_;
  std::uint32_t longest_bits_;
  Rng rng_;
  LinkPair pair_;
  Time start_ = pair_.now;
  double from_s_ = 3, to_s_ = 3.5;
  std::size_t pose_ = 0;
  std::uint32_t number_ = 0;
  std::vector<double> offered_s_;
  FirstPoses result_;
};

}  // namespace priamos::bus::radio
