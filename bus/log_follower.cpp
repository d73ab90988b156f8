#include "bus/log_follower.hpp"

#include <poll.h>

#include <algorithm>
#include <iterator>

#include "bus/clocks/host_clock.hpp"
#include "bus/host/service_notifier.hpp"

namespace priamos::bus {
namespace {

constexpr int kWait_ms = 50;
/// A gap of a log, or a stamp that is wrong, is not lived through tick by tick beyond this.
constexpr Duration kLongestGap = std::chrono::seconds(60);

}  // namespace

LogFollower::LogFollower(LcmBus& bus, const Schema& schema, std::string name, Starter start)
    : bus_(bus), schema_(schema), name_(std::move(name)), start_(std::move(start)) {
  bus_.PublishUnder(kPrefix);
  // The first subscription hears a message before the App does, which ticks up to it.
  bus_.SubscribeEverything(
      [this](std::string_view channel, std::span<const std::byte> bytes) { Hear(channel, bytes); });
}

/// What the App sent when it was recorded: it shows when it ticked.
bool LogFollower::IsOwn(std::string_view channel, std::span<const std::byte> bytes) const {
  if (channel == channels::kHealth.name) {
    const auto health = DecodeChecked<health_t>(schema_, bytes);
    return health && health->process == name_;
  }
  const auto& outputs = host_->node().outputs();
  return std::any_of(outputs.begin(), outputs.end(),
                     [channel](const Endpoint& output) { return output.channel == channel; });
}

void LogFollower::TickUntil(Time until, bool including) {
  if (until - host_->next_tick() > kLongestGap) host_->SkipTo(until - kLongestGap);
  while (!host_->exit_code() && (host_->next_tick() < until || (including && host_->next_tick() == until))) {
    clock_.Set(host_->next_tick());
    host_->Step(clock_.Now());
  }
  clock_.Set(std::max(until, clock_.Now()));
}

void LogFollower::Hear(std::string_view channel, std::span<const std::byte> bytes) {
  if (channel.starts_with(kPrefix)) return;
  const auto stamp = StampOf(schema_, bytes);
  if (!stamp) return;
  time_.Hear(*stamp);
  if (!host_ || time_.went_back()) return;
  const bool own = IsOwn(channel, bytes);
  if (own && *stamp <= *time_.now()) host_->TickNextAt(*stamp);
  TickUntil(*time_.now(), own);
}

std::optional<int> LogFollower::Run(const SignalWatch& signals) {
  const HostClock alive;
  ServiceNotifier notifier;
  while (!host_ || !host_->exit_code()) {
    pollfd fds[] = {{bus_.fd(), POLLIN, 0}, {signals.fd(), POLLIN, 0}};
    poll(fds, std::size(fds), kWait_ms);
    if (fds[1].revents != 0) return 0;
    bus_.Drain();
    notifier.Beat(alive.Now(), host_ ? host_->status() : "waits for the first message of a log");
    if (time_.went_back()) return std::nullopt;
    if (host_ || !time_.now()) continue;
    clock_.Set(*time_.now());
    host_ = start_(clock_);
  }
  return host_->exit_code();
}

}  // namespace priamos::bus
