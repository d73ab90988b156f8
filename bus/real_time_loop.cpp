#include "bus/real_time_loop.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <system_error>

#include "bus/claim_keeper.hpp"
#include "bus/clocks/clock_exchange.hpp"
#include "bus/host/service_notifier.hpp"

namespace priamos::bus {
namespace {

timespec ToTimespec(Duration d) {
  const auto us = std::max<Duration::rep>(0, d.count());
  return {static_cast<time_t>(us / 1000000), static_cast<long>(us % 1000000 * 1000)};
}

/// Whether a signal is ignored, as nohup leaves SIGHUP to a program that is to outlive its terminal.
bool IsIgnored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

SignalWatch::SignalWatch() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  if (!IsIgnored(SIGHUP)) sigaddset(&set, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  fd_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
}

SignalWatch::~SignalWatch() {
  close(fd_);
}

bool SignalWatch::Came(int within_ms) const {
  pollfd signal{fd_, POLLIN, 0};
  return poll(&signal, 1, within_ms) > 0;
}

int RunRealTime(AppHost& host, LcmBus& bus, const Clock& clock, const SignalWatch& signals,
                const BesideTheApp& beside) {
  ServiceNotifier notifier;
  while (!host.exit_code()) {
    const ClaimKeeper* claim = beside.claim;
    pollfd fds[] = {
        {bus.fd(), POLLIN, 0}, {signals.fd(), POLLIN, 0}, {claim != nullptr ? claim->fd() : -1, POLLIN, 0}};
    const timespec wait = ToTimespec(host.next_tick() - clock.Now());
    ppoll(fds, std::size(fds), &wait, nullptr);
    if (fds[1].revents != 0) return 0;
    if (fds[2].revents != 0) {
      host.Yield(clock.Now());
      throw BusError(*claim->lost());
    }
    if (fds[0].revents != 0) bus.Drain();
    const Time now = clock.Now();
    if (beside.clocks != nullptr) beside.clocks->Tick(now);
    if (now < host.next_tick()) continue;
    host.Step(now);
    notifier.Beat(now, host.status());
  }
  return *host.exit_code();
}

}  // namespace priamos::bus
