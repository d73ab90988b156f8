#include "bus/wire/udp_receiver.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "bus/wire/bus_error.hpp"
#include "bus/wire/datagram.hpp"
#include "bus/wire/multicast.hpp"
#include "bus/wire/network_interface.hpp"
#include "bus/wire/socket_filter.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kDatagramBytes = 1 << 16;
constexpr std::size_t kBatch = 32;
constexpr int kReceiveBuffer = 4 << 20;  // the kernel cuts it to net.core.rmem_max

[[noreturn]] void CannotJoin(const std::string& url, const char* what) {
  throw BusError(
      fmt::format("bus {}: {}: {}; `priamos doctor` names the missing route or flag and the "
                  "command that mends it",
                  url, what, std::strerror(errno)));
}

[[noreturn]] void CannotBind(const std::string& url) {
  if (errno != EADDRINUSE) CannotJoin(url, "expected a port");
  throw BusError(
      fmt::format("bus {}: expected a port to share, got one that another program has for itself; next: ss "
                  "-ulpn sport = :{} names it",
                  url, PortOf(url)));
}

void Join(int fd, const std::string& url) {
  const int yes = 1, no = 0;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(PortOf(url));
  ip_mreqn group{};
  if (inet_pton(AF_INET, GroupOf(url).c_str(), &group.imr_multiaddr) != 1)
    throw BusError(fmt::format("bus {}: expected a multicast address, got \"{}\"", url, GroupOf(url)));
  address.sin_addr = group.imr_multiaddr;
  if (const std::string network = NetworkOf(url); !network.empty())
    group.imr_ifindex = static_cast<int>(FindInterface(network).index);
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
  setsockopt(fd, IPPROTO_IP, IP_MULTICAST_ALL, &no, sizeof no);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) CannotBind(url);
  if (setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &group, sizeof group) != 0)
    CannotJoin(url, "expected to join the multicast group");
}

std::uint64_t NameOf(const sockaddr_in& sender) {
  return std::uint64_t{sender.sin_addr.s_addr} << 16 | sender.sin_port;
}

}  // namespace

/// Memory for one recvmmsg call. The pages of a datagram's buffer are touched only as far as it is long.
struct UdpReceiver::Batch {
  Batch() : bytes(std::make_unique_for_overwrite<std::byte[]>(kBatch * kDatagramBytes)) {
    for (std::size_t i = 0; i < kBatch; ++i) {
      parts[i] = {bytes.get() + i * kDatagramBytes, kDatagramBytes};
      messages[i] = {};
      messages[i].msg_hdr.msg_iov = &parts[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_name = &senders[i];
    }
  }
  std::span<const std::byte> Datagram(std::size_t i) const {
    return {bytes.get() + i * kDatagramBytes, messages[i].msg_len};
  }
  std::unique_ptr<std::byte[]> bytes;
  std::array<iovec, kBatch> parts;
  std::array<sockaddr_in, kBatch> senders{};
  std::array<mmsghdr, kBatch> messages;
};

UdpReceiver::UdpReceiver(const std::string& url, bool fragments) : batch_(std::make_unique<Batch>()) {
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd_ < 0) CannotJoin(url, "expected a socket");
  try {
    if (!fragments) FilterSocket(fd_);  // before the first datagram can come
    Join(fd_, url);
  } catch (...) {
    close(fd_);
    throw;
  }
}

UdpReceiver::~UdpReceiver() {
  close(fd_);
}

std::uint64_t UdpReceiver::turned_away() const {
  std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
  socklen_t size = sizeof info;
  return getsockopt(fd_, SOL_SOCKET, SO_MEMINFO, info.data(), &size) == 0 ? info[SK_MEMINFO_DROPS] : 0;
}

int UdpReceiver::ReceiveBatch(int at_most) {
  for (auto& message : batch_->messages) message.msg_hdr.msg_namelen = sizeof(sockaddr_in);
  const auto wanted = static_cast<unsigned>(std::min<int>(at_most, kBatch));
  return recvmmsg(fd_, batch_->messages.data(), wanted, MSG_DONTWAIT, nullptr);
}

void UdpReceiver::Take(std::uint64_t sender, std::span<const std::byte> datagram, const Handler& handler) {
  std::uint32_t number = 0;
  std::string_view channel;
  std::span<const std::byte> bytes;
  if (!ParseDatagram(datagram, number, channel, bytes)) return TakeFragment(sender, datagram, handler);
  numbers_.Add(sender, number);
  handler(sender, channel, bytes);
}

/// All fragments of a message carry its number: it counts once.
void UdpReceiver::TakeFragment(std::uint64_t sender, std::span<const std::byte> datagram,
                               const Handler& handler) {
  const auto result = reassembler_.Add(sender, datagram, large_);
  if (result == Reassembler::Result::kMalformed) ++malformed_;
  if (result == Reassembler::Result::kBegun) numbers_.Add(sender, FragmentHeader::Read(datagram)->number);
  if (result == Reassembler::Result::kComplete) handler(sender, large_.channel, large_.bytes);
}

int UdpReceiver::Receive(int at_most, const Handler& handler) {
  int handled = 0;
  while (handled < at_most) {
    const int n = ReceiveBatch(at_most - handled);
    if (n <= 0) break;
    handled += n;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
      Take(NameOf(batch_->senders[i]), batch_->Datagram(i), handler);
    if (n < static_cast<int>(kBatch)) break;
  }
  return handled;
}

std::string SenderAddress(std::uint64_t sender) {
  in_addr address{};
  address.s_addr = static_cast<in_addr_t>(sender >> 16);
  const auto port = ntohs(static_cast<std::uint16_t>(sender & 0xffff));
  // Where loopback has the only route for multicast, the kernel finds no address of that scope and sends from
  // none. Such a datagram never leaves its machine.
  if (address.s_addr == INADDR_ANY) return fmt::format("localhost:{}", port);
  char text[INET_ADDRSTRLEN] = "?";
  inet_ntop(AF_INET, &address, text, sizeof text);
  return fmt::format("{}:{}", text, port);
}

}  // namespace priamos::bus
