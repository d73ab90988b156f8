#pragma once

#include "bus/app_host.hpp"

namespace priamos::bus {

/// Turns SIGINT and SIGTERM into something a loop can look at. Create it before the first thread, so that
/// every thread inherits the blocked signals.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// Becomes readable when a signal came.
  int fd() const { return fd_; }

 private:
  int fd_;
};

/// Ticks the host at its period and drains the bus in between, until a signal or RequestStop. Tells systemd
/// (or whoever set NOTIFY_SOCKET) READY after the first tick and WATCHDOG with every later one.
int RunRealTime(AppHost& host, LcmBus& bus, const Clock& clock, const SignalWatch& signals);

}  // namespace priamos::bus
