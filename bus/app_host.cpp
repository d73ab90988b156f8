#include "bus/app_host.hpp"

#include <algorithm>

namespace priamos::bus {
namespace {

constexpr Duration kHealthPeriod = std::chrono::seconds(1);

std::int32_t Capped(std::uint64_t count) {
  return static_cast<std::int32_t>(std::min<std::uint64_t>(count, 1000000));
}

std::int8_t ToMessage(Health health) {
  switch (health) {
    case Health::kOk:
      return health_t::OK;
    case Health::kDegraded:
      return health_t::DEGRADED;
    case Health::kFailed:
      return health_t::FAILED;
  }
  return health_t::FAILED;
}

}  // namespace

AppHost::AppHost(const AppFactory& factory, const ConfigSource& source, LcmBus& bus, const Schema& schema,
                 const Clock& clock, Surroundings surroundings)
    : name_(factory.name),
      node_(bus, schema, clock),
      context_(node_, std::move(surroundings)),
      health_(node_.Advertise(channels::kHealth)),
      app_(factory.start(source, context_)),
      period_(app_->TickPeriod()),
      next_tick_(clock.Now()),
      next_health_(clock.Now()) {}

void AppHost::Step(Time now) {
  if (now < next_tick_) return;
  next_tick_ += period_;
  if (now >= next_tick_) {
    ++overruns_;
    next_tick_ = now + period_;
  }
  app_->Tick(now);
  if (now >= next_health_) PublishHealth(now);
}

void AppHost::PublishHealth(Time now) {
  next_health_ = now + kHealthPeriod;
  const ChannelCounters totals = node_.Totals();
  health_t message{};
  message.utime = ToUtime(now);
  message.process = name_.substr(0, 16);
  message.state = ToMessage(context_.health());
  message.messages_lost = Capped(totals.dropped + totals.publish_failed);
  message.decode_errors = Capped(totals.refused);
  message.handler_exceptions = Capped(totals.exceptions);
  message.loop_overruns = Capped(static_cast<std::uint64_t>(overruns_));
  message.text = context_.health_text();
  health_.Publish(message);
}

}  // namespace priamos::bus
