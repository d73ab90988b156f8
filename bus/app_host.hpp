#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "bus/app.hpp"
#include "bus/clocks/clock_offset.hpp"
#include "bus/parameters/parameter_desk.hpp"
#include "common/config.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::bus {

/// One App with its node and its schedule; the same in real time and in lockstep. It decides when a tick is
/// due, takes orders to change parameters between ticks, and publishes HEALTH once per second, also when the
/// App itself set none.
class AppHost {
 public:
  /// Starts the App; throws ConfigError, BusError or std::runtime_error with one sentence.
  AppHost(const AppFactory& factory, const ConfigSource& source, LcmBus& bus, const Schema& schema,
          const Clock& clock, Surroundings surroundings);

  const std::string& name() const { return name_; }
  Time next_tick() const { return next_tick_; }
  /// Ticks if a tick is due at `now`. A tick more than a period late is counted; those missed are not
  /// repeated.
  void Step(Time now);
  /// Moves the schedule by less than a period, so that a tick falls on `time`; further away it stays.
  void TickNextAt(Time time);
  /// No tick before `time`: what lies between is left out.
  void SkipTo(Time time) { next_tick_ = std::max(next_tick_, time); }
  /// The App's last act when another process has its role.
  void Yield(Time now) { app_->Yield(now); }
  /// Has HEALTH tell, beside the App's own problems, what `problems` says; empty text: nothing.
  void ReportProblemsOf(std::function<std::string()> problems) { further_problems_ = std::move(problems); }
  /// Has HEALTH say how far the clock is ahead of the reference of the bus; without it there is one clock.
  void ReportClockOf(std::function<std::optional<ClockDifference>()> ahead) {
    ahead_of_reference_ = std::move(ahead);
  }
  std::optional<int> exit_code() const { return context_.exit_code(); }
  const std::string& status() const { return context_.status(); }
  const Node& node() const { return node_; }

 private:
  /// Where the App's parameters are read and changed.
  struct Parameters {
    ParameterDesk desk;
    Inbox<parameter_order_t> orders;
    Publisher<parameter_value_t> values;
  };
  void OfferParameters(const ConfigSource& source);
  void TakeParameters(Time now);
  void PublishHealth(Time now);

  std::string HealthText() const;

  std::string name_;
  LcmBus& bus_;
  Node node_;
  Context context_;
  Publisher<health_t> health_;
  std::unique_ptr<AnyApp> app_;
  std::optional<Parameters> parameters_;  ///< none: the App has none that may be changed
  std::function<std::string()> further_problems_;
  std::function<std::optional<ClockDifference>()> ahead_of_reference_;
  Duration period_;
  Time next_tick_;
  Time next_health_;
  std::int32_t overruns_ = 0;
};

}  // namespace priamos::bus
