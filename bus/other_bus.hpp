#pragma once

#include <memory>
#include <string>

#include "bus/clocks/clock_exchange.hpp"
#include "bus/clocks/host_clock.hpp"
#include "bus/node.hpp"
#include "bus/wire/lcm_bus.hpp"

namespace priamos::bus {

/// A further bus of a process that joins several, beside the one that its host drains.
class OtherBus {
 public:
  /// Opens the bus at an LCM URL; `schema` and `clock` must outlive it. Throws BusError.
  OtherBus(const std::string& url, const Schema& schema, const HostClock& clock)
      : clock_(clock),
        bus_(url),
        clocks_(ExchangeWhereNeeded(bus_, schema, clock)),
        node_(bus_, schema, clock) {}

  Node& node() { return node_; }
  /// Handles everything that waits now.
  void Drain() {
    bus_.Drain();
    if (clocks_) clocks_->Tick(clock_.Now());
  }

 private:
  const HostClock& clock_;
  LcmBus bus_;
  std::unique_ptr<ClockExchange> clocks_;
  Node node_;
};

}  // namespace priamos::bus
