#include "bus/radio/frame_ack.hpp"

#include <algorithm>

namespace priamos::bus::radio {
namespace {

constexpr Duration kAckGap{250'000};
/// Well below the 64 that the low counter bits bridge.
constexpr std::uint64_t kFramesPerAck = 24;
constexpr std::size_t kRememberedFrames = 64;
constexpr std::uint64_t kLowBitsReach = 64;
/// Without an acknowledgement for so long, beside two round trips, nothing gets through.
constexpr Duration kUnanswered = 3 * kAckGap;
/// Of a slow line far more than an echo names; of a fast one still those of a second, when frames are not
/// tiny.
constexpr std::size_t kEchoedFrames = 4096;

}  // namespace

void FrameAckSender::OnFrame(std::uint64_t ahead) {
  ++frames_;
  if (ahead > 0) in_turn_ = (ahead < 64 ? in_turn_ << ahead : 0) | 1U;
}

bool FrameAckSender::Due(Time now) const {
  return frames_ > 0 && (Pressing() || !last_ || now - *last_ >= kAckGap);
}

bool FrameAckSender::Pressing() const {
  return frames_ >= kFramesPerAck;
}

FrameAckEntry FrameAckSender::Take(std::uint64_t highest, Time heard_at, double loss, Time now) {
  frames_ = 0;
  last_ = now;
  return {.counter = static_cast<std::uint16_t>(highest & 0xFFF),
          .earlier = static_cast<std::uint8_t>(in_turn_ >> 1 & ((1U << kEarlierFrames) - 1)),
          .hold = now - heard_at,
          .loss = loss};
}

void FrameAckSender::Return() {
  ++frames_;
  last_.reset();
}

void FrameAckSender::OnEpochChanged() {
  frames_ = 0;
  in_turn_ = 0;
}

void SentFrames::OnSent(std::uint64_t counter, Time end) {
  frames_.push_back({counter, end});
  if (frames_.size() > kRememberedFrames) frames_.pop_front();
}

std::vector<std::uint64_t> SentFrames::OnAck(const FrameAckEntry& ack, Time began) {
  peer_loss_ = ack.loss;
  acknowledged_at_ = began;
  std::vector<std::uint64_t> named;
  for (const Frame& frame : frames_) {
    const std::uint64_t back = (ack.counter - frame.counter) & 0xFFFU;
    if (back > kEarlierFrames || (back > 0 && (ack.earlier >> (back - 1) & 1U) == 0)) continue;
    named.push_back(frame.counter);
    if (back > 0) continue;
    confirmed_ = std::max(confirmed_.value_or(0), frame.counter);
    last_round_trip_ = std::max(began - frame.end - ack.hold, Duration::zero());
    latency_.Sample(began - frame.end - ack.hold);
  }
  return named;
}

CounterForm SentFrames::FormOf(std::uint64_t counter) const {
  return confirmed_ && counter <= *confirmed_ + kLowBitsReach ? CounterForm::kLowBits : CounterForm::kWhole;
}

double SentFrames::ExpectedLoss(Time now) const {
  const bool unanswered = acknowledged_at_ && now - *acknowledged_at_ > kUnanswered + 2 * last_round_trip_;
  return unanswered ? 1 : peer_loss_;
}

void SentFrames::OnHandedOver(std::uint64_t counter, Time now) {
  handed_over_.push_back({counter, now});
  if (handed_over_.size() > kEchoedFrames) handed_over_.pop_front();
}

std::optional<Time> SentFrames::HandedOver(std::uint64_t counter) const {
  const auto found = std::lower_bound(handed_over_.begin(), handed_over_.end(), counter,
                                      [](const Frame& f, std::uint64_t c) { return f.counter < c; });
  if (found == handed_over_.end() || found->counter != counter) return std::nullopt;
  return found->end;
}

void SentFrames::OnEpochChanged() {
  frames_.clear();
  handed_over_.clear();
  confirmed_ = 0;
}

}  // namespace priamos::bus::radio
