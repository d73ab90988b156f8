#include "bus/log/log_player.hpp"

#include <algorithm>

namespace priamos::bus {

LogPlayer::LogPlayer(LogReader reader, LogSelection selection)
    : reader_(std::move(reader)), selection_(std::move(selection)) {
  while (const auto event = reader_.Next())
    if (selection_.Wants(event->utime, event->channel)) index_.push_back({event->utime, event->offset});
  for (std::size_t i = 0; i < index_.size(); ++i) {
    if (i + 1 < index_.size()) index_[i].utime = std::min(index_[i].utime, index_[i + 1].utime);
    if (i > 0) index_[i].utime = std::max(index_[i].utime, index_[i - 1].utime);
  }
}

void LogPlayer::Anchor(Time now) {
  anchor_ = now;
  anchored_ = true;
  if (!index_.empty()) anchor_utime_ = index_[std::min(next_, index_.size() - 1)].utime;
}

Time LogPlayer::begin() const {
  return index_.empty() ? Time() : FromUtime(index_.front().utime);
}

Duration LogPlayer::position() const {
  if (index_.empty()) return {};
  return Duration(index_[std::min(next_, index_.size() - 1)].utime - index_.front().utime);
}

Duration LogPlayer::length() const {
  return index_.empty() ? Duration() : Duration(index_.back().utime - index_.front().utime);
}

void LogPlayer::SetSpeed(double speed, Time now) {
  speed_ = speed;
  Anchor(now);
}

void LogPlayer::Pause(bool paused, Time now) {
  paused_ = paused;
  Anchor(now);
}

void LogPlayer::Step(Time now) {
  Pause(true, now);
  ++steps_;
}

void LogPlayer::Seek(Duration position, Time now) {
  if (index_.empty()) return;
  const std::int64_t utime = index_.front().utime + std::clamp(position, Duration(), length()).count();
  const auto at = std::lower_bound(index_.begin(), index_.end(), utime,
                                   [](const Entry& entry, std::int64_t t) { return entry.utime < t; });
  next_ = static_cast<std::size_t>(at - index_.begin());
  Anchor(now);
}

Time LogPlayer::NextDue() const {
  if (done() || (paused_ && steps_ == 0)) return Time::max();
  if (!anchored_ || steps_ > 0 || speed_ <= kFlatOut) return Time::min();
  const auto since = static_cast<double>(index_[next_].utime - anchor_utime_) / speed_;
  constexpr double kYears = 1e15;  // a damaged time must not overflow the clock
  return anchor_ + Duration(static_cast<std::int64_t>(std::min(since, kYears)));
}

void LogPlayer::SendNext(const Send& send) {
  reader_.Seek(index_[next_++].offset);
  if (const auto event = reader_.Next()) send(selection_.NameOf(event->channel), *event);
}

void LogPlayer::BeginAgain(Time now) {
  next_ = 0;
  ++rounds_;
  Anchor(now);
}

int LogPlayer::Play(Time now, const Send& send, int at_most) {
  if (!anchored_) Anchor(now);
  int sent = 0;
  while (sent < at_most && NextDue() <= now) {
    SendNext(send);
    ++sent;
    if (steps_ > 0) --steps_;
    if (done() && loop_) BeginAgain(now);
  }
  return sent;
}

}  // namespace priamos::bus
