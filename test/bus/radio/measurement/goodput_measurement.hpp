#pragma once

#include <string>
#include <vector>

#include "numbered_message.hpp"

/// How much of the line is used, and what errors and losses leave of it. Simulated time.
namespace priamos::bus::radio {

struct Goodput {
  double bytes_per_s = 0;
  bool once_in_order = true;
};

/// Events without end over a line with errors.
inline Goodput EventGoodput(double bit_error_rate, std::uint64_t seed, double seconds) {
  LinkPair pair(LineConfig{.bit_error_rate = bit_error_rate}, seed);
  pair.RunUntil(30, [&] { return pair.onboard.link->Status(pair.now).up; });
  int number = 0;
  pair.each_step = [&] { KeepEventsWaiting(pair, pair.onboard, kEventUp, 104, number); };
  pair.Run(seconds);
  const auto texts = pair.offboard.TextsOf(kEventUp);
  Goodput goodput{104 * static_cast<double>(texts.size()) / seconds, true};
  for (std::size_t i = 0; i < texts.size(); ++i)
    goodput.once_in_order =
        goodput.once_in_order && texts[i].substr(0, texts[i].find(':')) == std::to_string(i);
  return goodput;
}

/// Share of a full line without errors that is bytes of messages, of events of so many bytes each.
inline double GoodputShare(std::size_t event_bytes, double seconds) {
  LinkPair pair;
  for (auto* end : {&pair.onboard, &pair.offboard}) {
    end->channels[kEventUp].fixed_bits = static_cast<std::uint32_t>(8 * event_bytes);
    end->channels[kEventUp].max_bits = end->channels[kEventUp].fixed_bits;
    pair.Start(*end);
  }
  int number = 0;
  pair.each_step = [&] { KeepEventsWaiting(pair, pair.onboard, kEventUp, event_bytes, number); };
  pair.Run(2);
  const std::size_t events = pair.offboard.TextsOf(kEventUp).size();
  const std::uint64_t bytes = pair.onboard.link->Status(pair.now).counters.bytes_sent;
  pair.Run(seconds);
  return static_cast<double>(event_bytes * (pair.offboard.TextsOf(kEventUp).size() - events)) /
         static_cast<double>(pair.onboard.link->Status(pair.now).counters.bytes_sent - bytes);
}

struct Saturation {
  double line_used = 0;     ///< share of what the line can carry
  double bundle_share = 0;  ///< of the bytes on the line
};

inline Saturation Saturate(double seconds) {
  LinkPair pair;
  int number = 0;
  pair.each_step = [&] {
    KeepEventsWaiting(pair, pair.onboard, kEventUp, 104, number);
    pair.onboard.link->Offer(kPoseUp, Text("0123456789"), pair.now);
  };
  pair.Run(2);
  const LinkCounters before = pair.onboard.link->Status(pair.now).counters;
  pair.Run(seconds);
  const LinkCounters after = pair.onboard.link->Status(pair.now).counters;
  const auto bytes = static_cast<double>(after.bytes_sent - before.bytes_sent);
  return {bytes / seconds / 960,
          static_cast<double>(after.bundle_bytes_sent - before.bundle_bytes_sent) / bytes};
}

/// Events both ways through lost frames and restarts of either end; true when every one came once, in order.
inline bool EventsArriveOnceInOrder(std::uint64_t seed, int events, double frame_loss, double restarts) {
  LinkPair pair({}, seed);
  Rng rng = Rng::Stream(seed, "faults");
  pair.lose_up = pair.lose_down = [&](std::span<const std::byte>) { return rng.Chance(frame_loss); };
  std::vector<std::string> up, down;
  for (int i = 0; i < events; ++i) {
    up.push_back("up " + std::to_string(i) + std::string(rng.Below(150), '.'));
    down.push_back("down " + std::to_string(i) + std::string(rng.Below(150), '.'));
    pair.onboard.link->Offer(kEventUp, Text(up.back()), pair.now);
    pair.offboard.link->Offer(kEventDown, Text(down.back()), pair.now);
    pair.Run(0.4);
    // Killed when it has saved what it delivered: in the millisecond before, it would deliver that again.
    for (auto* end : {&pair.onboard, &pair.offboard}) {
      if (!rng.Chance(restarts)) continue;
      end->link->Step(pair.now);
      pair.Start(*end);
    }
  }
  pair.Run(30);
  return pair.offboard.TextsOf(kEventUp) == up && pair.onboard.TextsOf(kEventDown) == down;
}

}  // namespace priamos::bus::radio
