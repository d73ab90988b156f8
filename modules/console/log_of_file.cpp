#include "console/log_of_file.hpp"

#include <algorithm>

namespace priamos::console {
namespace {

/// After a seek this part of the log before it is played at once: states are known by then.
constexpr Duration kBefore = std::chrono::seconds(15);
/// Most events between two looks at the pages.
constexpr int kAtMost = 2000;

}  // namespace

void LogOfFile::Play(Time now, LogListener& listener) {
  Play(now, listener, kAtMost);
}

void LogOfFile::Play(Time now, LogListener& listener, int at_most) {
  const auto hear = [&listener](const std::string& channel, const bus::LogEvent& event) {
    listener.Heard(channel, event.bytes, FromUtime(event.utime));
  };
  log_.Play(now, hear, at_most);
}

void LogOfFile::Obey(const ReplayOrder& order, Time now, LogListener& listener) {
  using enum ReplayOrder::Kind;
  switch (order.kind) {
    case kPlay:
      if (log_.position() >= log_.length()) Seek({}, now, listener);
      return log_.Pause(false, now);
    case kPause:
      return log_.Pause(true, now);
    case kStep:
      return log_.Step(now);
    case kSeek:
      return Seek(FromSeconds(order.value), now, listener);
    case kSpeed:
      return log_.SetSpeed(order.value, now);
  }
}

void LogOfFile::Seek(Duration position, Time now, LogListener& listener) {
  const bool paused = log_.paused();
  const double speed = log_.speed();
  listener.Begun();
  log_.Seek(std::max(position - kBefore, Duration::zero()), now);
  log_.Pause(false, now);
  log_.SetSpeed(bus::LogPlayer::kFlatOut, now);
  while (!log_.done() && log_.position() < std::min(position, log_.length())) Play(now, listener, 1);
  log_.SetSpeed(speed, now);
  log_.Pause(paused, now);
}

nlohmann::ordered_json LogOfFile::State() const {
  return {{"position_s", Seconds(log_.position())},
          {"speed", log_.speed()},
          {"paused", log_.paused() || log_.done()}};
}

}  // namespace priamos::console
