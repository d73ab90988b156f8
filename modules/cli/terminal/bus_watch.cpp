#include "cli/terminal/bus_watch.hpp"

#include <poll.h>

#include <iterator>
#include <utility>

#include "bus/real_time_loop.hpp"

namespace priamos::cli {
namespace {

constexpr double kHold_s = 3;
constexpr Duration kAskAgain{1'000'000};

}  // namespace

void Watch(bus::LcmBus& bus, const bus::Clock& clock, Time until, const std::function<bool()>& done,
           const std::function<void()>& every) {
  const bus::SignalWatch signals;
  while (clock.Now() < until && !done()) {
    pollfd fds[] = {{bus.fd(), POLLIN, 0}, {signals.fd(), POLLIN, 0}};
    poll(fds, std::size(fds), 100);
    if (fds[1].revents != 0) return;
    bus.Drain();
    every();
  }
}

LinkListener::LinkListener(bus::Node& node, std::vector<std::string> channels)
    : channels_(std::move(channels)), request_(node.Advertise(channels::kLinkRequest)) {}

LinkListener::~LinkListener() {
  Ask(last_, 0);
}

void LinkListener::Step(Time now) {
  last_ = now;
  if (now < next_) return;
  next_ = now + kAskAgain;
  Ask(now, kHold_s);
}

void LinkListener::Ask(Time now, double hold_s) {
  for (const std::string& channel : channels_) {
    link_request_t request{};
    request.utime = ToUtime(now);
    request.channel = channel;
    request.hold_s = hold_s;
    request_.Publish(request);
  }
}

}  // namespace priamos::cli
