#include "bus/app_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "bus/clocks/clock_health.hpp"
#include "bus/health_text.hpp"
#include "bus/parameters/parameter_messages.hpp"
#include "common/config.hpp"

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
      bus_(bus),
      node_(bus, schema, clock),
      context_(node_, std::move(surroundings)),
      health_(node_.Advertise(channels::kHealth)),
      app_(factory.start(source, context_)),
      period_(app_->TickPeriod()),
      next_tick_(clock.Now()),
      next_health_(clock.Now()) {
  OfferParameters(source);
}

void AppHost::OfferParameters(const ConfigSource& source) {
  ParameterStore* store = app_->parameters();
  const auto process = ParameterProcess(name_);
  if (store == nullptr || !process) return;
  ParameterDesk::Surroundings around{source.saved, [this] { app_->Reconfigure(); },
                                     [this](bool warning, std::string_view text) {
                                       context_.Log(warning ? Level::kWarning : Level::kInfo, text);
                                     }};
  parameters_.emplace(Parameters{{*process, *store, std::move(around)},
                                 node_.SubscribeAll(channels::kParameterOrder),
                                 node_.Advertise(channels::kParameterValue)});
}

void AppHost::TakeParameters(Time now) {
  if (!parameters_) return;
  for (const parameter_order_t& order : parameters_->orders.Drain())
    if (const auto answer = parameters_->desk.Take(order, now)) parameters_->values.Publish(*answer);
}

void AppHost::Step(Time now) {
  if (now < next_tick_) return;
  next_tick_ += period_;
  if (now >= next_tick_) {
    ++overruns_;
    next_tick_ = now + period_;
  }
  TakeParameters(now);
  app_->Tick(now);
  if (now >= next_health_) PublishHealth(now);
}

void AppHost::TickNextAt(Time time) {
  if (std::chrono::abs(time - next_tick_) < period_) next_tick_ = time;
}

/// The App's own state comes first; after it, per channel, what went wrong on the bus.
std::string AppHost::HealthText() const {
  std::string text = context_.health_text();
  std::string problems = node_.Problems();
  if (const auto n = bus_.turned_away(); n > 0)
    problems += (problems.empty() ? "" : "; ") + std::to_string(n) + " datagrams turned away by the kernel";
  if (parameters_ && parameters_->desk.refused() > 0)
    problems += fmt::format("{}parameter orders refused: {}", problems.empty() ? "" : "; ",
                            parameters_->desk.refused());
  if (const std::string more = further_problems_ ? further_problems_() : ""; !more.empty())
    problems = problems.empty() ? more : more + "; " + problems;
  if (!text.empty() && !problems.empty()) text += "; ";
  return FitHealthText(text + problems);
}

void AppHost::PublishHealth(Time now) {
  next_health_ = now + kHealthPeriod;
  context_.LogRefusalsLeftOut();
  const ChannelCounters totals = node_.Totals();
  health_t message{};
  message.utime = ToUtime(now);
  message.process = (context_.health_name().empty() ? name_ : context_.health_name()).substr(0, 16);
  message.state = ToMessage(context_.health());
  message.messages_lost = Capped(totals.dropped + totals.publish_failed + bus_.lost());
  message.decode_errors = Capped(totals.refused + bus_.malformed());
  message.handler_exceptions = Capped(totals.exceptions);
  message.loop_overruns = Capped(static_cast<std::uint64_t>(overruns_));
  SetClock(message, ahead_of_reference_ ? ahead_of_reference_() : ClockDifference{});
  message.text = HealthText();
  health_.Publish(message);
}

}  // namespace priamos::bus
