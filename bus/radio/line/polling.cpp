#include "bus/radio/line/polling.hpp"

#include <algorithm>

namespace priamos::bus::radio {

PollCycle::PollCycle(SharedChannel channel, std::uint8_t robots) : channel_(channel), robots_(robots) {}

std::uint8_t PollCycle::Next() {
  while (true) {
    const std::size_t i = next_;
    next_ = (next_ + 1) % robots_.size();
    if (robots_[i].skipped == 0) return static_cast<std::uint8_t>(i + 1);
    --robots_[i].skipped;
  }
}

void PollCycle::OnPollSent(std::uint8_t address, Time frame_end) {
  polled_ = address;
  poll_end_ = frame_end;
  heard_ = false;
}

void PollCycle::OnAnswer(Time now) {
  if (polled_) TakeBack(true, now + channel_.turnaround);
}

void PollCycle::Step(Time now) {
  if (!polled_) return;
  const Time first_byte = poll_end_ + 2 * channel_.latency + channel_.turnaround + channel_.grace;
  const Time end = first_byte + channel_.answer;
  // A silent robot cannot begin any more once its grace is over; a robot that talks is waited for.
  if (now > end) return TakeBack(false, end + channel_.turnaround);
  if (!heard_ && now > first_byte + channel_.turnaround) TakeBack(false, now);
}

void PollCycle::TakeBack(bool answered, Time free) {
  Robot& robot = robots_[*polled_ - 1U];
  robot.missed = answered ? 0 : std::min(robot.missed + 1, kMostSkipped + 1);
  robot.skipped = std::max(robot.missed - 1, 0);
  polled_.reset();
  free_ = free;
}

PollBounds ComputePollBounds(const SharedChannel& channel, const SharedFrames& frames, std::uint8_t robots,
                             Duration tick) {
  const Duration slot = frames.poll + 2 * channel.latency + channel.turnaround + channel.grace +
                        channel.answer + channel.turnaround + 2 * tick;
  const Duration one = slot + frames.urgent + channel.latency + tick;
  // Before the last of its turns begins, every second regular poll was followed by one out of turn.
  const int asked = (robots + kAskEvery - 2) / (kAskEvery - 1);
  return {.slot = slot,
          .cycle = (robots + asked) * slot,
          .asked = kAskEvery * slot,
          .urgent = frames.urgent + tick,
          .urgent_one = one,
          .urgent_all = one + (robots - 1) * (frames.urgent + tick)};
}

}  // namespace priamos::bus::radio
