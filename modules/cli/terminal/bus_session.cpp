#include "cli/terminal/bus_session.hpp"

#include <utility>

#include "bus/own_types.hpp"
#include "cli/terminal/bus_watch.hpp"

namespace priamos::cli {

BusSession::BusSession(std::string who, const BusOptions& options, std::string_view channel)
    : schema_(bus::OwnTypes()),
      bus_(options.bus.Url()),
      clocks_(bus::ExchangeWhereNeeded(bus_, schema_, clock_)),
      node_(bus_, schema_, clock_),
      silence_(std::move(who), options, std::string(channel), clock_.Now()) {}

void BusSession::Watch(Time until, const std::function<bool()>& done, const std::function<void()>& every) {
  cli::Watch(bus_, clock_, until, done, [&] {
    if (clocks_) clocks_->Tick(clock_.Now());
    every();
    silence_.Step(clock_.Now());
  });
}

}  // namespace priamos::cli
