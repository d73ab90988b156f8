#include "bus/radio/line/polling.hpp"

#include <algorithm>

namespace priamos::bus::radio {

void PolledTurn::OnPoll(Time now) {
  from_ = now + channel_.turnaround;
  began_.reset();
}

bool PolledTurn::MaySend(Time now, Duration length) const {
  if (!from_ || now < *from_) return false;
  // A late beginning would meet the station, which takes a silent robot's turn back.
  if (!began_) return now <= *from_ + channel_.grace && length <= channel_.turn;
  return now + length <= *began_ + channel_.turn;
}

void PolledTurn::OnSent(Time now, bool over) {
  if (!began_) began_ = now;
  if (over) from_.reset();
}

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
  heard_ = proven_ = false;
}

void PollCycle::OnFrame(std::uint8_t address, Time now, bool over) {
  if (polled_ != address) return;
  heard_ = proven_ = true;
  if (over) TakeBack(now + channel_.turnaround);
}

void PollCycle::Step(Time now) {
  if (!polled_) return;
  const Time first_byte = poll_end_ + 2 * channel_.latency + channel_.turnaround + channel_.grace;
  const Time end = first_byte + channel_.turn;
  // A silent robot cannot begin any more once its grace is over; a robot that talks is waited for.
  if (now > end) return TakeBack(end + channel_.turnaround);
  if (!heard_ && now > first_byte + channel_.turnaround) TakeBack(now);
}

void PollCycle::TakeBack(Time free) {
  Robot& robot = At(*polled_);
  robot.missed = proven_ ? 0 : std::min(robot.missed + 1, kMostSkipped + 1);
  robot.skipped = std::max(robot.missed - 1, 0);
  polled_.reset();
  free_ = free;
}

PollBounds ComputePollBounds(const SharedChannel& channel, const StationFrames& frames, std::uint8_t robots) {
  const Duration slot = frames.poll + 2 * channel.latency + channel.turnaround + channel.grace +
                        channel.turn + channel.turnaround;
  const Duration one = slot + frames.urgent + channel.latency;
  return {.cycle = robots * slot, .urgent_one = one, .urgent_all = one + (robots - 1) * frames.urgent};
}

}  // namespace priamos::bus::radio
