#pragma once

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bus/radio/budget.hpp"
#include "link_pair.hpp"

/// What the link does under load, errors, blackouts and attack, as figures: short runs for the tests, long
/// ones for test/bench/radio. Simulated time.
namespace priamos::bus::radio {

/// Keeps an outgoing event channel full of numbered events of `bytes` bytes.
inline void KeepEventsWaiting(LinkPair& pair, LinkPair::End& end, std::size_t channel, std::size_t bytes,
                              int& number) {
  while (end.link->waiting(channel) < 40) {
    std::string text = std::to_string(number++) + ":";
    text.resize(bytes, 'x');
    end.link->Offer(channel, Text(text), pair.now);
  }
}

/// Messages that say themselves whether they arrived as they were sent: 4 bytes of number, the rest follows
/// from it.
inline std::vector<std::byte> NumberedMessage(std::uint32_t number, std::size_t bytes) {
  std::vector<std::byte> message(bytes);
  std::uint64_t state = number * 0x9E3779B97F4A7C15U + bytes;
  for (std::size_t i = 4; i < bytes; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    message[i] = static_cast<std::byte>(state >> 56);
  }
  std::memcpy(message.data(), &number, 4);
  return message;
}
inline std::uint32_t NumberOf(std::span<const std::byte> message) {
  std::uint32_t number = 0;
  std::memcpy(&number, message.data(), std::min<std::size_t>(4, message.size()));
  return number;
}

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
    if (rng.Chance(restarts)) pair.Start(pair.onboard);
    if (rng.Chance(restarts)) pair.Start(pair.offboard);
  }
  pair.Run(30);
  return pair.offboard.TextsOf(kEventUp) == up && pair.onboard.TextsOf(kEventDown) == down;
}

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
  set(kStopDown, 4, 1, 0);
  set(kEventDown, 150, 1, 0);
  LinkChannel more = channels[kSlowUp];
  more.name = "MORE";
  more.direction = Direction::kDown;
  channels.push_back(more);
  return channels;
}

inline Overload MeasureOverload(std::uint64_t seed, double seconds) {
  LinkPair pair(LineConfig{.latency_s = 0}, seed);
  pair.onboard.channels = pair.offboard.channels = OverloadChannels();
  for (LinkPair::End* end : {&pair.onboard, &pair.offboard}) pair.Start(*end);
  const ChannelTable table(pair.onboard.channels, false);
  const Budget budget = ComputeBudget(table, pair.onboard.options);
  std::map<std::size_t, double> bound_s;
  for (const DirectionBudget* d : {&budget.up, &budget.down})
    for (const ChannelBudget& row : d->channels)
      if (row.worst_latency) bound_s[row.channel] = Seconds(*row.worst_latency);
  pair.Run(1.5);

  Overload result;
  Rng rng = Rng::Stream(seed, "offers");
  std::vector<Time> next(table.size(), pair.now);
  std::map<std::uint32_t, Time> offered;
  std::map<std::size_t, int> delivered;
  std::map<Direction, double> bytes;
  std::uint32_t number = 0;
  const auto offer = [&](std::size_t i) {
    const LinkChannel& c = table.at(i);
    auto& end = c.direction == Direction::kUp ? pair.onboard : pair.offboard;
    end.link->Offer(i, NumberedMessage(number, c.fixed_bits / 8), pair.now);
    offered[number++] = pair.now;
    bytes[c.direction] += c.fixed_bits / 8.0;
    const bool state = c.channel_class == ChannelClass::kState;
    next[i] += FromSeconds(state ? c.fixed_bits / 8.0 / 3000 : rng.Uniform(1, 1.2) / c.rate_hz);
  };
  const auto collect = [&](LinkPair::End& end) {
    for (const LinkPair::Received& r : end.received) {
      const std::size_t i = r.delivery.channel;
      ++delivered[i];
      if (table.at(i).channel_class == ChannelClass::kState) continue;
      const double latency_s = Seconds(r.at - offered.at(NumberOf(r.delivery.packed)));
      result.worst_bound_used = std::max(result.worst_bound_used, latency_s / bound_s.at(i));
      ++result.timed;
    }
    end.received.clear();
  };
  pair.each_step = [&] {
    for (std::size_t i = 0; i < table.size(); ++i) {
      if (pair.now >= next[i]) offer(i);
      const auto& link = table.at(i).direction == Direction::kUp ? pair.onboard.link : pair.offboard.link;
      if (table.at(i).ttl > Duration::zero())
        result.worst_queue_age = std::max(result.worst_queue_age,
                                          Seconds(link->OldestAge(i, pair.now)) / Seconds(table.at(i).ttl));
    }
    collect(pair.onboard);
    collect(pair.offboard);
  };
  pair.Run(seconds);
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table.at(i).channel_class == ChannelClass::kState)
      result.lowest_floor =
          std::min(result.lowest_floor, (delivered[i] + 1) / (seconds * table.at(i).rate_hz));
  result.offered_share = std::min(bytes[Direction::kUp], bytes[Direction::kDown]) / seconds / 960;
  return result;
}

/// A line that is up in windows of 1 s, 15 % of the time, dark for 1 to 30 s in between.
struct Blackouts {
  int returns = 0;
  double slowest_fresh_s = 0;   ///< from a return to a pose that was made after it
  double oldest_command_s = 0;  ///< when it was delivered
  int commands = 0;
  bool events_once_in_order = true;
};

inline std::vector<LineCut> DarkMostOfTheTime(Rng& rng, double until_s) {
  std::vector<LineCut> cuts;
  double t = 5;
  while (t < until_s) {
    // 1 s plus an exponential of 4.67 s: 1/0.15 s from window to window in the mean.
    const double dark = std::min(30.0, 1 + std::exponential_distribution<>(1 / 4.67)(rng.engine()));
    cuts.push_back({t, t + dark});
    t += dark + 1;
  }
  return cuts;
}

inline Blackouts MeasureBlackouts(std::uint64_t seed, double seconds) {
  Rng rng = Rng::Stream(seed, "blackouts");
  const std::vector<LineCut> cuts = DarkMostOfTheTime(rng, seconds);
  LineConfig line;
  line.cuts = cuts;
  LinkPair pair(line, seed);
  const Time start = pair.now;
  Blackouts result;
  std::vector<std::string> up, down;
  std::map<std::uint32_t, Time> offered;
  std::uint32_t number = 0;
  std::size_t next_cut = 0;
  std::optional<Time> returned;
  const auto offer = [&](LinkPair::End& end, std::size_t channel, std::size_t bytes) {
    end.link->Offer(channel, NumberedMessage(number, bytes), pair.now);
    offered[number++] = pair.now;
  };
  pair.each_step = [&] {
    const double s = Seconds(pair.now - start);
    if (ToUtime(pair.now) % 20'000 == 0) offer(pair.onboard, kPoseUp, 10);
    if (ToUtime(pair.now) % 20'000 == 0) offer(pair.offboard, kDriveDown, 5);
    if (ToUtime(pair.now) % 10'000'000 == 0 && s < seconds - 60) {
      up.push_back("up at " + std::to_string(s));
      down.push_back("down at " + std::to_string(s));
      pair.onboard.link->Offer(kEventUp, Text(up.back()), pair.now);
      pair.offboard.link->Offer(kEventDown, Text(down.back()), pair.now);
    }
    if (next_cut < cuts.size() && s >= cuts[next_cut].to_s)
      returned = start + FromSeconds(cuts[next_cut++].to_s);
    auto& poses = pair.offboard.received;
    std::erase_if(poses, [&](const LinkPair::Received& r) {
      if (r.delivery.channel != kPoseUp) return false;
      if (returned && offered.at(NumberOf(r.delivery.packed)) >= *returned) {
        result.slowest_fresh_s = std::max(result.slowest_fresh_s, Seconds(r.at - *returned));
        ++result.returns;
        returned.reset();
      }
      return true;
    });
    std::erase_if(pair.onboard.received, [&](const LinkPair::Received& r) {
      if (r.delivery.channel != kDriveDown) return false;
      const double age_s = Seconds(r.at - offered.at(NumberOf(r.delivery.packed)));
      result.oldest_command_s = std::max(result.oldest_command_s, age_s);
      ++result.commands;
      return true;
    });
  };
  pair.Run(seconds + 60);
  result.events_once_in_order =
      pair.offboard.TextsOf(kEventUp) == up && pair.onboard.TextsOf(kEventDown) == down;
  return result;
}

/// Frames over a line with bit errors, error bursts and doubled bytes; is any message delivered that was not
/// sent? A faster line, so that many frames take little simulated time.
struct DamagedFrames {
  std::uint64_t sent = 0;
  std::uint64_t rejected = 0;
  std::uint64_t delivered = 0;
  std::uint64_t wrong = 0;
};

inline DamagedFrames SendDamagedFrames(double bit_error_rate, std::uint64_t seed, std::uint64_t frames) {
  LineConfig line{.baud = 1'000'000, .latency_s = 0.002, .bit_error_rate = bit_error_rate};
  line.burst_rate_hz = 20;
  line.burst_length_s = 0.001;
  line.duplicate_probability = 1e-4;
  LinkOptions options;
  options.bytes_per_s = 100'000;
  options.ahead_bytes = 110;
  LinkPair pair(line, seed, options);
  for (LinkPair::End* end : {&pair.onboard, &pair.offboard}) {
    for (LinkChannel& c : end->channels) c.rate_hz = 0;
    pair.Start(*end);
  }
  DamagedFrames result;
  std::uint32_t number = 0;
  const auto fill = [&](LinkPair::End& end, std::size_t state, std::size_t bytes, std::size_t event) {
    end.link->Offer(state, NumberedMessage(number, bytes), pair.now);
    ++number;
    while (end.link->waiting(event) < 20) {
      end.link->Offer(event, NumberedMessage(number, 8 + number % 120), pair.now);
      ++number;
    }
  };
  const auto check = [&](LinkPair::End& end) {
    for (const LinkPair::Received& r : end.received) {
      const auto& got = r.delivery.packed;
      ++result.delivered;
      if (got != NumberedMessage(NumberOf(got), got.size())) ++result.wrong;
    }
    end.received.clear();
    pair.wire_up.clear();
    pair.wire_down.clear();
  };
  pair.each_step = [&] {
    fill(pair.onboard, kPoseUp, 10, kEventUp);
    fill(pair.offboard, kDriveDown, 5, kEventDown);
    check(pair.onboard);
    check(pair.offboard);
  };
  while (result.sent < frames) {
    pair.Run(1);
    result.sent = result.rejected = 0;
    for (const LinkPair::End* end : {&pair.onboard, &pair.offboard}) {
      const LinkCounters counters = end->link->Status(pair.now).counters;
      result.sent += counters.frames_sent;
      for (const std::uint64_t n : counters.rejected) result.rejected += n;
    }
  }
  return result;
}

/// Frames as they were on the line, delimiter included.
inline std::vector<std::vector<std::byte>> FramesOf(const std::vector<std::byte>& wire) {
  std::vector<std::vector<std::byte>> frames(1);
  for (const std::byte b : wire) {
    frames.back().push_back(b);
    if (b == kDelimiter) frames.emplace_back();
  }
  frames.pop_back();
  return frames;
}

/// The receiver under attack: the same boot, a later one with its memory, a later one that lost it.
enum class Boot { kSame, kLater, kLaterForgot };

struct Attack {
  std::uint64_t tried = 0;
  std::uint64_t accepted = 0;   ///< data frames
  std::uint64_t delivered = 0;  ///< messages
  bool alarm = false;
  bool still_works = false;  ///< afterwards the true other end is heard within a second
};

/// Replayed, mutated, foreign-direction and random frames, as fast as the line could bring them.
inline Attack AttackReceiver(Boot boot, std::uint64_t seed, std::uint64_t frames) {
  LinkPair pair({}, seed);
  pair.each_step = [&] {
    pair.onboard.link->Offer(kPoseUp, Text("0123456789"), pair.now);
    pair.offboard.link->Offer(kDriveDown, Text("abcde"), pair.now);
  };
  pair.Run(5);
  const auto own_direction = FramesOf(pair.wire_up), other_direction = FramesOf(pair.wire_down);
  if (boot == Boot::kLaterForgot) pair.offboard.store.Lose();
  if (boot != Boot::kSame) pair.Start(pair.offboard);
  if (boot == Boot::kLaterForgot) pair.Run(2);
  LinkEndpoint& receiver = *pair.offboard.link;
  const std::uint64_t before = receiver.Status(pair.now).counters.frames_received;
  Rng rng = Rng::Stream(seed, "attack");
  Attack attack;
  for (; attack.tried < frames; ++attack.tried) {
    pair.now += Duration(7300);  // the smallest frame's time on the line
    const auto& from = rng.Chance(0.2) ? other_direction : own_direction;
    auto frame = from[rng.Below(from.size())];
    if (rng.Chance(0.2)) {
      frame.resize(5 + rng.Below(60));
      for (std::byte& b : frame) b = static_cast<std::byte>(rng.Below(256));
    }
    const int changes = static_cast<int>(rng.Below(4));  // 0: a plain replay
    for (int k = 0; k < changes; ++k) frame[rng.Below(frame.size())] = static_cast<std::byte>(rng.Below(256));
    frame.push_back(kDelimiter);
    attack.delivered += receiver.Receive(frame, pair.now).size();
    attack.alarm = attack.alarm || receiver.Status(pair.now).alarm;
  }
  attack.accepted = receiver.Status(pair.now).counters.frames_received - before;
  // The line kept its pace meanwhile.
  pair.offboard.received.clear();
  pair.Run(1);
  attack.still_works = !pair.offboard.received.empty();
  return attack;
}

}  // namespace priamos::bus::radio
