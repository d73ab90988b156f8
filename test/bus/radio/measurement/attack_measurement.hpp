#pragma once

#include <array>
#include <vector>

#include "numbered_message.hpp"

/// What damaged and hostile frames do to a link. Simulated time.
namespace priamos::bus::radio {

/// Frames over a line with bit errors, error bursts and doubled bytes; is any message delivered that was not
/// sent?
struct DamagedFrames {
  std::uint64_t sent = 0;
  std::uint64_t rejected = 0;
  std::uint64_t delivered = 0;
  std::uint64_t wrong = 0;
};

/// Both ways on a line of 100 kbyte/s, so that many frames take little simulated time.
class DamageRun {
 public:
  DamageRun(double bit_error_rate, std::uint64_t seed)
      : pair_(LineOf(bit_error_rate), seed, {.bytes_per_s = 100'000, .ahead_bytes = 110}) {
    for (LinkPair::End* end : {&pair_.onboard, &pair_.offboard}) {
      for (LinkChannel& c : end->channels) c.rate_hz = 0;
      pair_.Start(*end);
    }
  }

  DamagedFrames Run(std::uint64_t frames) {
    pair_.each_step = [this] { Step(); };
    while (result_.sent < frames) {
      pair_.Run(1);
      Count();
    }
    return result_;
  }

 private:
  static LineConfig LineOf(double bit_error_rate) {
    LineConfig line{.baud = 1'000'000, .latency_s = 0.002, .bit_error_rate = bit_error_rate};
    line.burst_rate_hz = 20;
    line.burst_length_s = 0.001;
    line.duplicate_probability = 1e-4;
    return line;
  }
  void Step() {
    Fill(pair_.onboard, kPoseUp, 10, kEventUp);
    Fill(pair_.offboard, kDriveDown, 5, kEventDown);
    Check(pair_.onboard);
    Check(pair_.offboard);
    pair_.wire_up.clear();
    pair_.wire_down.clear();
  }
  void Fill(LinkPair::End& end, std::size_t newest, std::size_t bytes, std::size_t event) {
    end.link->Offer(newest, NumberedMessage(number_++, bytes), pair_.now);
    for (; end.link->waiting(event) < 20; ++number_)
      end.link->Offer(event, NumberedMessage(number_, 8 + number_ % 120), pair_.now);
  }
  void Check(LinkPair::End& end) {
    for (const LinkPair::Received& r : end.received) {
      const auto& got = r.delivery.packed;
      ++result_.delivered;
      if (got != NumberedMessage(NumberOf(got), got.size())) ++result_.wrong;
    }
    end.received.clear();
  }
  void Count() {
    result_.sent = result_.rejected = 0;
    for (const LinkPair::End* end : {&pair_.onboard, &pair_.offboard}) {
      const LinkCounters counters = end->link->Status(pair_.now).counters;
      result_.sent += counters.frames_sent;
      for (const std::uint64_t n : counters.rejected) result_.rejected += n;
    }
  }

  LinkPair pair_;
  DamagedFrames result_;
  std::uint32_t number_ = 0;
};

inline DamagedFrames SendDamagedFrames(double bit_error_rate, std::uint64_t seed, std::uint64_t frames) {
  return DamageRun(bit_error_rate, seed).Run(frames);
}

/// The receiver under attack: the same boot, a later one with its memory, a later one that lost it.
enum class Boot { kSame, kLater, kLaterForgot };

struct Attack {
  std::uint64_t tried = 0;
  std::uint64_t accepted = 0;   ///< data frames
  std::uint64_t delivered = 0;  ///< messages
  std::uint64_t flooded = 0;    ///< not even looked at: faster than the line
  bool alarm = false;
  bool still_works = false;  ///< afterwards the true other end is heard within a second
};

/// Replayed, mutated, foreign-direction and random frames, as fast as the line could bring them.
class AttackRun {
 public:
  AttackRun(Boot boot, std::uint64_t seed) : pair_({}, seed), rng_(Rng::Stream(seed, "attack")) {
    pair_.each_step = [this] {
      pair_.onboard.link->Offer(kPoseUp, Text("0123456789"), pair_.now);
      pair_.offboard.link->Offer(kDriveDown, Text("abcde"), pair_.now);
    };
    pair_.Run(5);
    own_direction_ = FramesOf(pair_.wire_up);
    other_direction_ = FramesOf(pair_.wire_down);
    if (boot == Boot::kLaterForgot) pair_.offboard.store.Lose();
    if (boot != Boot::kSame) pair_.Start(pair_.offboard);
    if (boot == Boot::kLaterForgot) pair_.Run(2);
  }

  Attack Run(std::uint64_t frames) {
    Attack attack;
    LinkEndpoint& receiver = *pair_.offboard.link;
    const LinkCounters before = receiver.Status(pair_.now).counters;
    for (; attack.tried < frames; ++attack.tried) {
      pair_.now += Duration(7300);  // the smallest frame's time on the line
      attack.delivered += receiver.Receive(Forged(), pair_.now).size();
      attack.alarm = attack.alarm || receiver.Status(pair_.now).alarm;
    }
    const LinkCounters after = receiver.Status(pair_.now).counters;
    constexpr auto kFlood = static_cast<std::size_t>(Reject::kFlood);
    attack.accepted = after.frames_received - before.frames_received;
    attack.flooded = after.rejected[kFlood] - before.rejected[kFlood];
    // The line kept its pace meanwhile.
    pair_.offboard.received.clear();
    pair_.Run(1);
    attack.still_works = !pair_.offboard.received.empty();
    return attack;
  }

 private:
  std::byte AnyByte() { return static_cast<std::byte>(rng_.Below(256)); }
  std::vector<std::byte> Forged() {
    const auto& from = rng_.Chance(0.2) ? other_direction_ : own_direction_;
    auto frame = from[rng_.Below(from.size())];
    if (rng_.Chance(0.2)) {
      frame.resize(5 + rng_.Below(60));
      for (std::byte& b : frame) b = AnyByte();
    }
    const int changes = static_cast<int>(rng_.Below(4));  // 0: a plain replay
    for (int k = 0; k < changes; ++k) frame[rng_.Below(frame.size())] = AnyByte();
    frame.push_back(kDelimiter);
    return frame;
  }

  LinkPair pair_;
  Rng rng_;
  std::vector<std::vector<std::byte>> own_direction_, other_direction_;
};

inline Attack AttackReceiver(Boot boot, std::uint64_t seed, std::uint64_t frames) {
  return AttackRun(boot, seed).Run(frames);
}

}  // namespace priamos::bus::radio
