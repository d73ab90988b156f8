#include "bus/log_follower.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "bus/clocks/host_clock.hpp"
#include "bus/host/service_notifier.hpp"

namespace priamos::bus {
namespace {

constexpr int kWait_ms = 50;
/// A gap of a log, or a stamp that is wrong, is not lived through tick by tick beyond this.
constexpr Duration kLongestGap = std::chrono::seconds(60);
/// A bus that says nothing for so long, by the host's clock, is silent.
constexpr Duration kSilence = std::chrono::seconds(2);

/// Says what is to be said when a bus has fallen silent, once.
class SilenceWatch {
 public:
  explicit SilenceWatch(Time now) : since_(now) {}
  /// Whether it has just become silent; `heard` counts all messages.
  bool Begins(Time now, std::uint64_t heard) {
    if (heard != heard_) {
      heard_ = heard;
      since_ = now;
      told_ = false;
    }
    return now - since_ > kSilence && !std::exchange(told_, true);
  }

 private:
  Time since_;
  std::uint64_t heard_ = 0;
  bool told_ = false;
};

}  // namespace

LogFollower::LogFollower(LcmBus& bus, const Schema& schema, std::string name, Starter start,
                         std::vector<HeardMessage> first)
    : bus_(bus), schema_(schema), name_(std::move(name)), start_(std::move(start)), first_(std::move(first)) {
  bus_.PublishUnder(kPrefix);
  // The first subscription hears a message before the App does, which ticks up to it.
  bus_.SubscribeEverything(
      [this](std::string_view channel, std::span<const std::byte> bytes) { Hear(channel, bytes); });
}

LogFollower::~LogFollower() {
  bus_.UnsubscribeAll();
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
  ++heard_;
  const auto stamp = StampOf(schema_, bytes);
  if (!stamp || !LogTime::IsPlausible(*stamp)) return;
  if (!host_) {  // it has no ears yet
    first_.push_back({std::string(channel), {bytes.begin(), bytes.end()}});
    return;
  }
  time_.Hear(*stamp, IdentityOf(channel, bytes));
  beginning_.Note(time_, channel, bytes);
  if (time_.is_behind()) return;
  const bool own = IsOwn(channel, bytes);
  if (own && *stamp <= *time_.now()) host_->TickNextAt(*stamp);
  TickUntil(*time_.now(), own);
}

/// Makes the App at the time of the first message, which it hears with all that have come since.
void LogFollower::Begin() {
  clock_.Set(*StampOf(schema_, first_.front().bytes));
  host_ = start_(clock_);
  host_->ReportProblemsOf([this] { return Problems(); });
  for (const HeardMessage& message : std::exchange(first_, {})) bus_.Deliver(message.channel, message.bytes);
}

std::string LogFollower::Problems() const {
  return time_.far_behind() == 0
             ? ""
             : fmt::format("{} messages more than 2 s behind the log", time_.far_behind());
}

std::string LogFollower::NotFollowed() const {
  if (!host_ && first_.empty() && heard_ > 0)
    return fmt::format(
        "{} messages heard, none with a time stamp that can be a log's: nothing is decided; next: play a log "
        "of this robot's types",
        heard_);
  if (const std::size_t n = beginning_.size(); n > 0)
    return fmt::format(
        "{} messages are from earlier in the log: too few to tell that it was started again, so it is not "
        "begun anew; next: play more of it, or start this process again",
        n);
  return "";
}

std::optional<int> LogFollower::Run(const SignalWatch& signals,
                                    const std::function<void(const std::string&)>& warn) {
  const HostClock alive;
  SilenceWatch silence(alive.Now());
  ServiceNotifier notifier;
  while (!host_ || !host_->exit_code()) {
    pollfd fds[] = {{bus_.fd(), POLLIN, 0}, {signals.fd(), POLLIN, 0}};
    poll(fds, std::size(fds), kWait_ms);
    if (fds[1].revents != 0) return 0;
    bus_.Drain();
    notifier.Beat(alive.Now(), host_ ? host_->status() : "waits for the first message of a log");
    if (time_.went_back()) return std::nullopt;
    if (!host_ && !first_.empty()) Begin();
    if (silence.Begins(alive.Now(), heard_) && warn && !NotFollowed().empty()) warn(NotFollowed());
  }
  return host_->exit_code();
}

}  // namespace priamos::bus
