#include "bus/wire/udp_sender.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "bus/schema/big_endian.hpp"
#include "bus/wire/bus_error.hpp"
#include "bus/wire/datagram.hpp"
#include "bus/wire/multicast.hpp"
#include "bus/wire/network_interface.hpp"
#include "bus/wire/reassembler.hpp"

namespace priamos::bus {
namespace {

// What liblcm puts into one datagram: the most that UDP carries, without its headers.
constexpr std::size_t kShortBytes = 65499, kFragmentBytes = 65487;
constexpr std::size_t kMostFragments = 65535;

sockaddr_in GroupAddress(const std::string& url) {
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(PortOf(url));
  inet_pton(AF_INET, GroupOf(url).c_str(), &group.sin_addr);
  return group;
}

/// Has datagrams to a group leave by the interface `network`, from its address if it is one.
bool ChooseInterface(int fd, const std::string& network) {
  if (network.empty()) return true;
  ip_mreqn way{};
  way.imr_ifindex = static_cast<int>(FindInterface(network).index);
  inet_pton(AF_INET, network.c_str(), &way.imr_address);
  return setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &way, sizeof way) == 0;
}

/// Hands the parts of one datagram to the kernel.
bool SendParts(int fd, const sockaddr_in& to, std::span<const std::span<const std::byte>> parts,
               int flags = 0) {
  std::array<iovec, 4> vectors{};
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    vectors[i] = {const_cast<std::byte*>(parts[i].data()), parts[i].size()};
    bytes += parts[i].size();
  }
  msghdr message{};
  message.msg_name = const_cast<sockaddr_in*>(&to);
  message.msg_namelen = sizeof to;
  message.msg_iov = vectors.data();
  message.msg_iovlen = parts.size();
  ssize_t sent = -1;
  do sent = sendmsg(fd, &message, flags);
  while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(bytes);
}

std::array<std::byte, 8> ShortHeader(std::uint32_t number) {
  std::array<std::byte, 8> header;
  WriteBigEndian(header.data(), kShortMagic);
  WriteBigEndian(header.data() + 4, number);
  return header;
}

bool IsChannel(std::string_view name) {
  return !name.empty() && name.size() <= kLongestChannel &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
}

constexpr std::array<std::byte, 1> kZero{};

/// Linux keeps datagrams of ttl 0 on this host only where somebody on it is a member of their group; others
/// leave. So the sender is one. It hears nothing by that: its port is not the bus's.
bool KeepOnThisHost(int fd, const in_addr& group, const std::string& network) {
  ip_mreqn member{};
  member.imr_multiaddr = group;
  if (!network.empty()) member.imr_ifindex = static_cast<int>(FindInterface(network).index);
  const int no = 0;
  setsockopt(fd, IPPROTO_IP, IP_MULTICAST_ALL, &no, sizeof no);
  return setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &member, sizeof member) == 0;
}

}  // namespace

UdpSender::UdpSender(const std::string& url) : ttl_(TtlOf(url)) {
  RequireMulticastUrl(url);
  RequireMulticastRoute(url);
  group_ = GroupAddress(url);
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const auto ttl = static_cast<unsigned char>(ttl_);
  const bool ready = fd_ >= 0 && setsockopt(fd_, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl) == 0 &&
                     ChooseInterface(fd_, NetworkOf(url)) &&
                     (ttl_ > 0 || KeepOnThisHost(fd_, group_.sin_addr, NetworkOf(url)));
  if (ready) return;
  const std::string reason = std::strerror(errno);
  if (fd_ >= 0) close(fd_);
  throw BusError(
      fmt::format("bus {}: expected a socket to send by, got \"{}\"; `priamos doctor` names what is "
                  "missing and the command that mends it",
                  url, reason));
}

UdpSender::~UdpSender() {
  close(fd_);
}

bool UdpSender::Send(std::string_view channel, std::span<const std::byte> bytes) {
  if (!IsChannel(channel)) return false;
  const std::lock_guard lock(mutex_);
  if (channel.size() + 1 + bytes.size() > kShortBytes) return SendFragments(channel, bytes);
  const auto header = ShortHeader(number_++);
  const std::array<std::span<const std::byte>, 4> parts{header, std::as_bytes(std::span(channel)), kZero,
                                                        bytes};
  return SendParts(fd_, group_, parts);
}

bool UdpSender::SendTo(std::uint64_t receiver, std::string_view channel, std::span<const std::byte> bytes) {
  if (!IsChannel(channel) || channel.size() + 1 + bytes.size() > kShortBytes) return false;
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = static_cast<in_addr_t>(receiver >> 16);
  to.sin_port = static_cast<in_port_t>(receiver & 0xffff);
  const auto header = ShortHeader(0);
  const std::array<std::span<const std::byte>, 4> parts{header, std::as_bytes(std::span(channel)), kZero,
                                                        bytes};
  return SendParts(fd_, to, parts, ttl_ > 1 ? MSG_DONTWAIT : MSG_DONTWAIT | MSG_DONTROUTE);
}

/// The first fragment carries the channel and a zero before its data.
bool UdpSender::SendFragments(std::string_view channel, std::span<const std::byte> bytes) {
  const std::size_t named = channel.size() + 1;
  const std::size_t fragments = (named + bytes.size() + kFragmentBytes - 1) / kFragmentBytes;
  if (fragments > kMostFragments) return false;
  FragmentHeader header{number_++, static_cast<std::uint32_t>(bytes.size()), 0, 0,
                        static_cast<std::uint16_t>(fragments)};
  for (std::size_t offset = 0; header.fragment < fragments; ++header.fragment) {
    header.offset = static_cast<std::uint32_t>(offset);
    const bool first = header.fragment == 0;
    const auto data =
        bytes.subspan(offset, std::min(bytes.size() - offset, kFragmentBytes - (first ? named : 0)));
    const auto written = header.Write();
    const auto name = std::as_bytes(std::span(channel)).first(first ? channel.size() : 0);
    const std::array<std::span<const std::byte>, 4> parts{
        written, name, std::span<const std::byte>(kZero).first(first ? 1 : 0), data};
    if (!SendParts(fd_, group_, parts)) return false;
    offset += data.size();
  }
  return true;
}

}  // namespace priamos::bus
