#pragma once

#include "bus/app_host.hpp"

namespace priamos::bus {

class ClaimKeeper;
class ClockExchange;

/// What a process does on its bus beside its App; null: it does not.
struct BesideTheApp {
  const ClaimKeeper* claim = nullptr;  ///< when it is lost, the App yields and BusError gives the reason
  ClockExchange* clocks = nullptr;
};

/// Turns SIGINT, SIGTERM and SIGHUP (unless it is ignored) into something a loop can look at. Create it
/// before the first thread, so that every thread inherits the blocked signals.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// File descriptor that becomes readable when a signal came.
  int fd() const { return fd_; }
  /// Whether one came, or comes within that time.
  bool Came(int within_ms = 0) const;

 private:
  int fd_;
};

/// Ticks the host at its period and drains the bus in between, until a signal or RequestStop. Reports to
/// systemd (or whoever set NOTIFY_SOCKET) READY after the first tick and WATCHDOG with every later one.
int RunRealTime(AppHost& host, LcmBus& bus, const Clock& clock, const SignalWatch& signals,
                const BesideTheApp& beside);

}  // namespace priamos::bus
