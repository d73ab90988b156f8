#pragma once

#include <string>

#include "bus/node.hpp"
#include "bus/wire/lcm_bus.hpp"

namespace priamos::bus {

/// A further bus of a process that joins several, beside the one that its host drains.
class OtherBus {
 public:
  /// Opens the bus at an LCM URL; `schema` and `clock` must outlive it. Throws BusError.
  OtherBus(const std::string& url, const Schema& schema, const Clock& clock)
      : bus_(url), node_(bus_, schema, clock) {}

  Node& node() { return node_; }
  /// Handles everything that waits now.
  void Drain() { bus_.Drain(); }

 private:
  LcmBus bus_;
  Node node_;
};

}  // namespace priamos::bus
