#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace priamos::cli {

/// The receiving end of sd_notify(3): what systemd is to a service, for processes that `priamos` starts.
class NotifySocket {
 public:
  /// One datagram of a process: READY=1 sets `ready`, WATCHDOG=1 sets `alive`, STATUS=... is a line for a
  /// person.
  struct Message {
    pid_t pid = 0;  ///< who sent it, by the kernel
    bool ready = false, alive = false;
    std::string status{};
  };

  /// Opens the socket. Throws std::system_error when that fails.
  NotifySocket();
  ~NotifySocket();
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  int fd() const { return fd_; }
  /// Value of NOTIFY_SOCKET: a name in the abstract namespace, which leaves no file behind.
  const std::string& name() const { return name_; }
  /// What has come since the last call.
  std::vector<Message> Read();

 private:
  int fd_ = -1;
  std::string name_;
};

}  // namespace priamos::cli
