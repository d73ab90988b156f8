#include "bus/radio/line/link_quality.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::bus::radio {
namespace {

constexpr double kMemoryFrames = 32;
constexpr std::uint64_t kMostMissed = 256;
constexpr double kBurstOfTries = 256;  // a tty's buffer after a pause of this process
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
    : tries_per_s_(tries_per_s), tries_(kBurstOfTries), tries_at_(start), level_at_(start) {}

bool ForgeryGuard::MayTry(Time now) {
  tries_ = std::min(kBurstOfTries, tries_ + Seconds(now - tries_at_) * tries_per_s_);
  tries_at_ = now;
  if (tries_ < 1) {
    Raise(1, now);
    return false;
  }
  tries_ -= 1;
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
