#include "bus/radio/line/link_quality.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bus::radio {
namespace {

constexpr double kMemoryFrames = 32;
constexpr std::uint64_t kMostMissed = 256;
constexpr double kBurstOfTries = 256;  // a tty's buffer after a pause of this process
/// Expected frames: bounds the processor time (1 us each) of a flood whose frames look right.
constexpr double kExpectedPerSecond = 30'000;
constexpr double kBurstOfExpected = 5'000;
/// Those of strangers: few, for a true other end that has moved proves itself within a few frames.
constexpr double kStrangersPerSecond = 50;
constexpr double kAlarmLevel = 20;
constexpr double kMaxLevel = 200;
constexpr double kDecayPerSecond = 1;
/// One damaged frame may be received as several.
constexpr double kPiecesPerFrame = 1.5;

}  // namespace

void LossMeter::OnFrame(std::uint64_t missed, std::size_t wire_bytes) {
  for (std::uint64_t i = 0; i < std::min(missed, kMostMissed); ++i) loss_ += (1 - loss_) / kMemoryFrames;
  loss_ -= loss_ / kMemoryFrames;
  mean_bytes_ += (static_cast<double>(wire_bytes) - mean_bytes_) / kMemoryFrames;
}

double LossMeter::BitErrorRate() const {
  return 1 - std::pow(1 - std::min(loss_, 0.999), 1 / (10 * mean_bytes_));
}

ForgeryGuard::ForgeryGuard(double tries_per_s, Time start)
    : bounds_{{{kExpectedPerSecond, kBurstOfExpected, kBurstOfExpected, start},
               {tries_per_s, kBurstOfTries, kBurstOfTries, start},
               {kStrangersPerSecond, kStrangersPerSecond, kStrangersPerSecond, start}}},
      level_at_(start) {}

bool ForgeryGuard::MayTry(Claim claim, Time now) {
  Bound& bound = bounds_[static_cast<std::size_t>(claim)];
  bound.left = std::min(bound.burst, bound.left + Seconds(now - bound.at) * bound.per_s);
  bound.at = now;
  if (bound.left < 1) {
    Raise(1, now);
    return false;
  }
  bound.left -= 1;
  return true;
}

void ForgeryGuard::Raise(double weight, Time now) {
  level_ = std::max(0.0, level_ - Seconds(now - level_at_) * kDecayPerSecond);
  level_ = std::min(kMaxLevel, level_ + weight);
  level_at_ = now;
}

void ForgeryGuard::OnMissed(std::uint64_t frames) {
  level_ = std::max(0.0, level_ - kPiecesPerFrame * static_cast<double>(std::min(frames, kMostMissed)));
}

bool ForgeryGuard::alarm(Time now) const {
  return level_ - Seconds(now - level_at_) * kDecayPerSecond > kAlarmLevel;
}

}  // namespace priamos::bus::radio
