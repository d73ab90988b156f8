#include "bus/host/service_notifier.hpp"

#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace priamos::bus {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(200);

}  // namespace

ServiceNotifier::ServiceNotifier() : ServiceNotifier(std::getenv("NOTIFY_SOCKET")) {}

ServiceNotifier::ServiceNotifier(const char* address) {
  const std::string_view name = address ? address : "";
  if (name.empty() || name.size() >= sizeof address_.sun_path) return;
  fd_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  address_.sun_family = AF_UNIX;
  std::memcpy(address_.sun_path, name.data(), name.size());
  // An abstract name begins with a zero and has no end but its length.
  if (name[0] == '@') address_.sun_path[0] = '\0';
  length_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + (name[0] == '@' ? 0 : 1));
}

ServiceNotifier::~ServiceNotifier() {
  if (fd_ >= 0) close(fd_);
}

bool ServiceNotifier::Say(std::string_view text) {
  return sendto(fd_, text.data(), text.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address_),
                length_) == static_cast<ssize_t>(text.size());
}

/// What could not be sent is sent again at the next call.
void ServiceNotifier::Beat(Time now, std::string_view status) {
  if (fd_ < 0 || now < next_) return;
  std::string text = ready_sent_ ? "WATCHDOG=1" : "READY=1\nWATCHDOG=1";
  if (status != status_) text.append("\nSTATUS=").append(status);
  if (!Say(text)) return;
  ready_sent_ = true;
  status_ = status;
  next_ = now + kPeriod;
}

}  // namespace priamos::bus
