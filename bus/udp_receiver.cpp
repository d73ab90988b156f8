#include "bus/udp_receiver.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "bus/lcm_bus.hpp"
#include "bus/multicast.hpp"
#include "bus/schema/big_endian.hpp"
#include "bus/socket_filter.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kHeaderBytes = 8;
constexpr std::size_t kLongestChannel = 63;
constexpr std::size_t kDatagramBytes = 1 << 16;
constexpr std::size_t kBatch = 32;
constexpr int kReceiveBuffer = 4 << 20;  // the kernel cuts it to net.core.rmem_max

[[noreturn]] void CannotJoin(const std::string& url, const char* what) {
  throw BusError(
      fmt::format("bus {}: {}: {}; `priamos doctor` names the missing route or flag and the "
                  "command that mends it",
                  url, what, std::strerror(errno)));
}

void Join(int fd, const std::string& url) {
  const int yes = 1, no = 0;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(PortOf(url));
  ip_mreq group{};
  if (inet_pton(AF_INET, GroupOf(url).c_str(), &group.imr_multiaddr) != 1)
    throw BusError(fmt::format("bus {}: expected a multicast address, got \"{}\"", url, GroupOf(url)));
  address.sin_addr = group.imr_multiaddr;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
  setsockopt(fd, IPPROTO_IP, IP_MULTICAST_ALL, &no, sizeof no);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    CannotJoin(url, "expected a free port");
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

bool ParseDatagram(std::span<const std::byte> datagram, std::uint32_t& number, std::string_view& channel,
                   std::span<const std::byte>& bytes) {
  constexpr std::uint32_t kShortMagic = 0x4c433032;  // "LC02"
  if (datagram.size() <= kHeaderBytes || ReadBigEndian<std::uint32_t>(datagram.data()) != kShortMagic)
    return false;
  const auto rest = datagram.subspan(kHeaderBytes);
  const auto name = rest.first(std::min(rest.size(), kLongestChannel + 1));
  const auto end = std::find(name.begin(), name.end(), std::byte{0});
  // Names that nobody could type or read back from a log are nonsense or an attack.
  const auto printable = [](std::byte b) { return b >= std::byte{0x20} && b < std::byte{0x7f}; };
  if (end == name.end() || end == name.begin() || !std::all_of(name.begin(), end, printable)) return false;
  number = ReadBigEndian<std::uint32_t>(datagram.data() + 4);
  channel = {reinterpret_cast<const char*>(rest.data()), static_cast<std::size_t>(end - name.begin())};
  bytes = rest.subspan(channel.size() + 1);
  return true;
}

UdpReceiver::UdpReceiver(const std::string& url) : batch_(std::make_unique<Batch>()) {
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd_ < 0) CannotJoin(url, "expected a socket");
  try {
    FilterSocket(fd_);  // before the first datagram can come
    Join(fd_, url);
  } catch (...) {
    close(fd_);
    throw;
  }
}

UdpReceiver::~UdpReceiver() {
  close(fd_);
}

int UdpReceiver::ReceiveBatch(int at_most) {
  for (auto& message : batch_->messages) message.msg_hdr.msg_namelen = sizeof(sockaddr_in);
  const auto wanted = static_cast<unsigned>(std::min<int>(at_most, kBatch));
  return recvmmsg(fd_, batch_->messages.data(), wanted, MSG_DONTWAIT, nullptr);
}

int UdpReceiver::Receive(int at_most, const Handler& handler) {
  int handled = 0;
  while (handled < at_most) {
    const int n = ReceiveBatch(at_most - handled);
    if (n <= 0) break;
    handled += n;
    for (int i = 0; i < n; ++i) {
      std::uint32_t number = 0;
      std::string_view channel;
      std::span<const std::byte> bytes;
      if (!ParseDatagram(batch_->Datagram(static_cast<std::size_t>(i)), number, channel, bytes)) {
        ++malformed_;
        continue;
      }
      numbers_.Add(NameOf(batch_->senders[static_cast<std::size_t>(i)]), number);
      handler(channel, bytes);
    }
    if (n < static_cast<int>(kBatch)) break;
  }
  return handled;
}

}  // namespace priamos::bus
