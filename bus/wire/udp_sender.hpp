#pragma once

#include <netinet/in.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <string_view>

namespace priamos::bus {

/// Sends the messages of an LCM multicast bus, in place of liblcm, which can name no network interface.
///
/// A message goes out as one datagram, longer ones (over 64 kB) in fragments, as liblcm sends them. Thread
/// safe.
class UdpSender {
 public:
  /// Opens the way that a `udpm://` URL describes: group, port, ttl, network. Throws BusError when there is
  /// none.
  explicit UdpSender(const std::string& url);
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  /// Sends a message to the bus; false when the channel's name is none (1 to 63 printable characters) or the
  /// network refused it.
  bool Send(std::string_view channel, std::span<const std::byte> bytes);
  /// Sends a short message to one socket alone, whose name UdpReceiver gave. It has no number of this
  /// sender's series. Only a host in this network is reached, unless the bus crosses routers.
  bool SendTo(std::uint64_t receiver, std::string_view channel, std::span<const std::byte> bytes);

  /// File descriptor that becomes readable when somebody answered to this socket alone.
  int fd() const { return fd_; }

 private:
  bool SendFragments(std::string_view channel, std::span<const std::byte> bytes);

  int fd_ = -1;
  sockaddr_in group_{};
  int ttl_ = 0;
  std::mutex mutex_;  ///< guards number_; fragments of two messages do not mix
  std::uint32_t number_ = 0;
};

}  // namespace priamos::bus
