#include "console/log_on_bus.hpp"

#include <algorithm>

#include "bus/log_follower.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "console/greeting.hpp"

namespace priamos::console {
namespace {

constexpr Duration kMeasured = std::chrono::seconds(1);

bool IsShown(std::string_view channel) {
  return std::find(kShownChannels.begin(), kShownChannels.end(), channel) != kShownChannels.end();
}

}  // namespace

LogOnBus::LogOnBus(bus::LcmBus& bus, const bus::Schema& schema) : bus_(bus), schema_(schema) {
  bus_.SubscribeEverything(
      [this](std::string_view channel, std::span<const std::byte> bytes) { Hear(channel, bytes); });
}

void LogOnBus::Play(Time now, LogListener& listener) {
  listener_ = &listener;
  bus_.Drain();
  listener_ = nullptr;
  MeasureSpeed(now);
}

void LogOnBus::Hear(std::string_view channel, std::span<const std::byte> bytes) {
  if (channel.starts_with(bus::LogFollower::kPrefix)) return;
  if (const auto stamp = bus::StampOf(schema_, bytes)) {
    log_time_.Hear(*stamp, bus::IdentityOf(channel, bytes));
    beginning_.Note(log_time_, channel, bytes);
  }
  if (!log_time_.now()) return;
  if (log_time_.went_back()) return BeginAgain();
  if (!begin_) begin_ = log_time_.now();
  if (IsShown(channel)) listener_->Heard(std::string(channel), bytes, *log_time_.now());
}

void LogOnBus::BeginAgain() {
  log_time_ = {};
  begin_.reset();
  listener_->Begun();
  for (const bus::HeardMessage& message : beginning_.Take()) Hear(message.channel, message.bytes);
}

void LogOnBus::MeasureSpeed(Time now) {
  if (now - measured_ < kMeasured) return;
  speed_ = measured_ == Time{} || log_measured_ == Time{}
               ? 0
               : std::max(0.0, Seconds(time() - log_measured_) / Seconds(now - measured_));
  measured_ = now;
  log_measured_ = time();
}

nlohmann::ordered_json LogOnBus::State() const {
  return {
      {"position_s", Seconds(time() - begin_.value_or(time()))}, {"speed", speed_}, {"paused", speed_ == 0}};
}

}  // namespace priamos::console
