#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// Share of frames that do not arrive, over about the last 32, and the bit error rate that explains it.
class LossMeter {
 public:
  /// A frame arrived; `missed` counters before it never did.
  void OnFrame(std::uint64_t missed, std::size_t wire_bytes);
  double loss() const { return loss_; }
  double BitErrorRate() const;

 private:
  double loss_ = 0;
  double mean_bytes_ = 40;
};

/// What a frame looks like before its code is checked.
enum class Claim : std::uint8_t {
  kExpected,  ///< a hello, or what the other end can send next: counter and echo fit
  kOther,     ///< the form of a frame, but not what is expected
  kStranger   ///< from a place where the other end is not, while it is heard where it is
};
inline constexpr std::size_t kClaims = 3;

/// Guard against forged frames: it bounds how many codes are checked per second, and detects frames that the
/// other end cannot have sent. Noise damages frames of the other end, whose counters are missed later; more
/// refused frames than that are forged. Each claim has a bound of its own, so that a flood of one does not
/// use up the checks of the others.
class ForgeryGuard {
 public:
  /// Guard with `tries_per_s`, the number of smallest frames that the line can carry [1/s].
  ForgeryGuard(double tries_per_s, Time start);

  /// Whether this frame may be checked; false if there were too many of its claim.
  bool MayTry(Claim claim, Time now);
  void OnBadCode(Time now) { Raise(1, now); }
  void OnReplay(Time now) { Raise(kReplayWeight, now); }
  void OnMissed(std::uint64_t frames);
  bool alarm(Time now) const;

 private:
  static constexpr double kReplayWeight = 25;
  void Raise(double weight, Time now);

  struct Bound {
    double per_s, burst, left;
    Time at;
  };
  std::array<Bound, kClaims> bounds_;  ///< by Claim
  double level_ = 0;
  Time level_at_;
};

/// Limit of answers that an attacker can provoke: some at once, few on average.
class AnswerLimit {
 public:
  explicit AnswerLimit(Time start) : refilled_at_(start) {}
  bool Allows(Time now) const { return Level(now) >= 1; }
  void Use(Time now) {
    level_ = Level(now) - 1;
    refilled_at_ = now;
  }

 private:
  static constexpr double kBurst = 4;
  static constexpr double kPerSecond = 2;
  double Level(Time now) const {
    const double level = level_ + Seconds(now - refilled_at_) * kPerSecond;
    return level < kBurst ? level : kBurst;
  }
  double level_ = kBurst;
  Time refilled_at_;
};

/// Estimate of the one-way delay of the line: half of the smallest round trip seen, without time on the wire
/// and in the other end.
class LatencyMeter {
 public:
  void Sample(Duration round_trip) {
    if (!valid_ || round_trip < smallest_) smallest_ = round_trip;
    valid_ = true;
  }
  Duration one_way() const { return smallest_ > Duration::zero() ? smallest_ / 2 : Duration::zero(); }

 private:
  bool valid_ = false;
  Duration smallest_{};
};

}  // namespace priamos::bus::radio
