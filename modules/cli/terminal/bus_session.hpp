#pragma once

#include <functional>
#include <memory>
#include <string>

#include "bus/clocks/clock_exchange.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/node.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "cli/options/bus_options.hpp"
#include "cli/terminal/silence_watch.hpp"

namespace priamos::cli {

/// A verb that waits for PRIAMOS's own messages on a bus: a node there, and one sentence on standard error
/// when what it waits for does not come.
class BusSession {
 public:
  /// Session of the verb `who`, e.g. "priamos where". `channel`: what is waited for.
  BusSession(std::string who, const BusOptions& options, std::string_view channel);

  bus::Node& node() { return node_; }
  const bus::Schema& schema() const { return schema_; }
  Time now() const { return clock_.Now(); }
  /// Notes that a message came, so that there is no silence to explain.
  void Heard() { silence_.Heard(); }

  /// Listens until `until`, a signal or `done`; calls `every` ten times a second.
  void Watch(Time until, const std::function<bool()>& done, const std::function<void()>& every);

 private:
  const bus::Schema schema_;
  const bus::HostClock clock_;
  bus::LcmBus bus_;
  std::unique_ptr<bus::ClockExchange> clocks_;
  bus::Node node_;
  SilenceWatch silence_;
};

}  // namespace priamos::cli
