#include "cli/supervise/process_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace priamos::cli {

const char* Text(ProcessState state) {
  switch (state) {
    case ProcessState::kWaiting:
      return "waiting";
    case ProcessState::kStarting:
      return "starting";
    case ProcessState::kReady:
      return "ready";
    case ProcessState::kBackOff:
      return "back-off";
    case ProcessState::kStopping:
      return "stopping";
    case ProcessState::kStopped:
      return "stopped";
  }
  return "";
}

bool ProcessWatch::runs() const {
  return state_ == ProcessState::kStarting || state_ == ProcessState::kReady ||
         state_ == ProcessState::kStopping;
}

void ProcessWatch::Enter(ProcessState state, Time now) {
  state_ = state;
  since_ = now;
}

ProcessWatch::Action ProcessWatch::Step(bool may_start, bool may_stop, Time now) {
  if (stopping_) return WatchStop(may_stop, now);
  if (restarting_ && runs()) return EndForRestart(now);
  if (std::exchange(restarting_, false)) Enter(ProcessState::kWaiting, now);
  if (state_ == ProcessState::kWaiting) return may_start ? Action::kStart : Action::kNone;
  if (state_ == ProcessState::kBackOff) {
    const auto doublings = std::clamp(failures_ - 1, 0, 20);
    const Duration wait = std::min(policy_.first_back_off * (1 << doublings), policy_.longest_back_off);
    return may_start && now - since_ >= wait ? Action::kStart : Action::kNone;
  }
  return runs() ? WatchRunning(now) : Action::kNone;
}

/// The time since then, without that in which it waited for a processor.
Duration ProcessWatch::Silence(Time since, Duration limit, Time now) const {
  return now - since - std::min(waited_ - waited_before_, policy_.starved * limit);
}

ProcessWatch::Action ProcessWatch::WatchRunning(Time now) {
  if (killed_) return Action::kNone;
  if (stopped_since_ && now - *stopped_since_ >= policy_.stopped) {
    verdict_ = fmt::format("hung: stopped for {:.1f} s", Seconds(now - *stopped_since_));
  } else if (state_ == ProcessState::kStarting &&
             Silence(since_, policy_.ready_within, now) > policy_.ready_within) {
    verdict_ = fmt::format("not ready within {:.0f} s", Seconds(policy_.ready_within));
  } else if (state_ == ProcessState::kReady && policy_.watchdog > Duration::zero() &&
             Silence(alive_, policy_.watchdog, now) > policy_.watchdog) {
    verdict_ = fmt::format("hung: silent for {:.1f} s", Seconds(now - alive_));
  } else {
    if (state_ == ProcessState::kReady && now - since_ >= policy_.stable_after) failures_ = 0;
    return Action::kNone;
  }
  killed_ = true;
  return Action::kKill;
}

ProcessWatch::Action ProcessWatch::WatchStop(bool may_stop, Time now) {
  if (state_ == ProcessState::kStopping) return WatchEnding(now);
  if (!runs()) {
    if (state_ != ProcessState::kStopped) Enter(ProcessState::kStopped, now);
    return Action::kNone;
  }
  return may_stop ? Terminate(now) : Action::kNone;
}

ProcessWatch::Action ProcessWatch::EndForRestart(Time now) {
  return state_ == ProcessState::kStopping ? WatchEnding(now) : Terminate(now);
}

ProcessWatch::Action ProcessWatch::Terminate(Time now) {
  Enter(ProcessState::kStopping, now);
  return Action::kTerminate;
}

ProcessWatch::Action ProcessWatch::WatchEnding(Time now) {
  if (killed_ || now - since_ <= policy_.stop_within) return Action::kNone;
  killed_ = true;
  verdict_ = fmt::format("did not end within {:.0f} s", Seconds(policy_.stop_within));
  return Action::kKill;
}

void ProcessWatch::Started(Time now) {
  ++starts_;
  killed_ = false;
  verdict_.clear();
  alive_ = now;
  waited_ = waited_before_ = {};
  stopped_since_.reset();
  Enter(ProcessState::kStarting, now);
}

void ProcessWatch::SeenStopped(bool stopped, Time now) {
  if (!stopped) {
    stopped_since_.reset();
  } else if (!stopped_since_) {
    stopped_since_ = now;
  }
}

void ProcessWatch::SaidAlive(Time now) {
  alive_ = now;
  if (state_ == ProcessState::kReady) waited_before_ = waited_;
}

void ProcessWatch::SaidReady(Time now) {
  if (state_ == ProcessState::kStarting) Enter(ProcessState::kReady, now);
  SaidAlive(now);
}

void ProcessWatch::Exited(const std::string& how, Time now) {
  reason_ = verdict_.empty() ? how : verdict_ + ", " + how;
  if (restarting_ && !stopping_) {
    restarting_ = false;
    reason_ = "started again by order, " + reason_;
    return Enter(ProcessState::kWaiting, now);
  }
  if (state_ == ProcessState::kStopping || stopping_) return Enter(ProcessState::kStopped, now);
  ++failures_;
  Enter(ProcessState::kBackOff, now);
}

}  // namespace priamos::cli
