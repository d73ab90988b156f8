#pragma once

#include <sys/socket.h>
#include <sys/un.h>

#include <string>
#include <string_view>

#include "common/time.hpp"

namespace priamos::bus {

/// Reports to whoever started this process, by the protocol of sd_notify(3), that it is ready and that it is
/// alive. Unlike sd_notify it never waits: ten messages that nobody reads fill the socket, and a supervisor
/// that stands still must not make its processes stand still as well.
class ServiceNotifier {
 public:
  /// Reports to the address in the environment variable NOTIFY_SOCKET, or to nobody when it is not set.
  ServiceNotifier();
  /// Reports to `address`: a path, or @ and a name in the abstract namespace; null or empty: nobody.
  explicit ServiceNotifier(const char* address);
  ~ServiceNotifier();
  ServiceNotifier(const ServiceNotifier&) = delete;
  ServiceNotifier& operator=(const ServiceNotifier&) = delete;

  /// Sends READY and WATCHDOG at the first call, afterwards WATCHDOG every 0.2 s. Call it after every useful
  /// piece of work. `status`: a line for a person, sent along whenever it changes; empty: none.
  void Beat(Time now, std::string_view status = "");

 private:
  bool Say(std::string_view text);

  int fd_ = -1;
  sockaddr_un address_{};
  socklen_t length_ = 0;
  bool ready_sent_ = false;
  std::string status_;  ///< as sent
  Time next_{};
};

}  // namespace priamos::bus
