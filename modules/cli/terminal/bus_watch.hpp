#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bus/clocks/clock.hpp"
#include "bus/node.hpp"
#include "bus/wire/lcm_bus.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::cli {

/// Polls bus and signals until `until`, a signal or `done`; calls `every` ten times a second.
void Watch(bus::LcmBus& bus, const bus::Clock& clock, Time until, const std::function<bool()>& done,
           const std::function<void()>& every);

/// Has on-request channels of the other side of the radio sent for as long as it lives; harmless on a bus
/// without a radio.
class LinkListener {
 public:
  LinkListener(bus::Node& node, std::vector<std::string> channels);
  ~LinkListener();
  LinkListener(const LinkListener&) = delete;
  LinkListener& operator=(const LinkListener&) = delete;

  /// Asks again when it is time; to be called at least once a second.
  void Step(Time now);

 private:
  void Ask(Time now, double hold_s);

  std::vector<std::string> channels_;
  bus::Publisher<link_request_t> request_;
  Time next_{};
  Time last_{};
};

}  // namespace priamos::cli
