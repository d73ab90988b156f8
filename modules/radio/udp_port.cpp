// A frame per datagram. The other end has a connected socket, whose buffer nobody else can fill; who sends
// from elsewhere fills that of another one.
#include <fmt/format.h>
#include <linux/filter.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "common/text/number_text.hpp"
#include "radio/net_socket.hpp"

namespace priamos::radio {
namespace {

using bus::radio::kDelimiter;
using bus::radio::Proof;

constexpr int kReceiveBuffer = 4 << 20;  // the kernel cuts it to net.core.rmem_max
constexpr std::size_t kBatch = 64;
/// Datagrams read at once: more than a flood brings in a tick, and a bound for its length.
constexpr std::size_t kMostOfPeer = 1024, kMostOfStrangers = 256;
constexpr std::uint32_t kUdpHead = 8;  // a socket filter on UDP sees the UDP head first

/// The kernel drops what is too short or too long for a frame; a datagram need not have the delimiter.
void LimitSizes(const Fd& fd) {
  std::array<sock_filter, 5> code{{
      BPF_STMT(BPF_LD | BPF_W | BPF_LEN, 0),
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, kUdpHead + kSmallestFrame - 1, 0, 2),
      BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, kUdpHead + kLargestFrame, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, 0xffffffff),
      BPF_STMT(BPF_RET | BPF_K, 0),
  }};
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  if (setsockopt(fd.get(), SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) != 0)
    throw std::runtime_error(fmt::format("socket filter: {}", std::strerror(errno)));
}

std::uint64_t Dropped(const Fd& fd) {
  std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
  socklen_t size = sizeof info;
  return getsockopt(fd.get(), SOL_SOCKET, SO_MEMINFO, info.data(), &size) == 0 ? info[SK_MEMINFO_DROPS] : 0;
}

struct Place {
  sockaddr_storage address{};
  socklen_t size = 0;
};

class UdpPort : public NetPort {
 public:
  explicit UdpPort(const NetAddress& address) : local_port_(address.local_port) {
    const AddressInfo peer = LookUp(address);
    strangers_ = Bound(*peer, address.loopback_only);
    peer_ = Bound(*peer, address.loopback_only);
    // From now on the kernel passes to this one nothing but what comes from there.
    if (connect(peer_.get(), peer->ai_addr, peer->ai_addrlen) != 0)
      throw std::runtime_error(
          fmt::format("{}:{} cannot be reached: {}", address.host, address.port, std::strerror(errno)));
  }

  std::vector<NetFrame> Read(const TimeSource& time) override {
    std::vector<NetFrame> frames;
    places_.clear();
    ReadFrom(peer_, kMostOfPeer, false, time, frames);
    ReadFrom(strangers_, kMostOfStrangers, true, time, frames);
    return frames;
  }

  void Judge(const NetFrame& frame, Proof proof) override {
    if (proof == Proof::kFresh) heard_at_ = frame.arrived;
    if (!frame.stranger) return;
    const Place& place = places_.at(frame.place);
    if (proof == Proof::kGenuine) maybe_ = place;
    if (proof != Proof::kFresh) return;
    maybe_.reset();
    (void)connect(peer_.get(), reinterpret_cast<const sockaddr*>(&place.address), place.size);
  }

  std::size_t Write(std::span<const std::byte> bytes, Time now) override {
    for (const std::byte b : bytes) {
      frame_.push_back(b);
      if (b != kDelimiter) continue;
      // A lone delimiter is nothing. What the network does not take is lost.
      if (frame_.size() > 1) Send(now);
      frame_.clear();
    }
    return bytes.size();
  }

  std::uint64_t turned_away() const override { return Dropped(peer_) + Dropped(strangers_); }

 private:
  Fd Bound(const addrinfo& peer, bool loopback_only) const {
    Fd fd = Socket(peer);
    LimitSizes(fd);
    setsockopt(fd.get(), SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
    sockaddr_storage local{};
    local.ss_family = static_cast<sa_family_t>(peer.ai_family);
    const auto port = htons(NumberOf<std::uint16_t>(local_port_).value());
    if (peer.ai_family == AF_INET) {
      auto& in = reinterpret_cast<sockaddr_in&>(local);
      in.sin_port = port;
      in.sin_addr.s_addr = htonl(loopback_only ? INADDR_LOOPBACK : INADDR_ANY);
    } else {
      auto& in6 = reinterpret_cast<sockaddr_in6&>(local);
      in6.sin6_port = port;
      in6.sin6_addr = loopback_only ? in6addr_loopback : in6addr_any;
    }
    addrinfo info = peer;
    info.ai_addr = reinterpret_cast<sockaddr*>(&local);
    Bind(fd, info, local_port_);
    return fd;
  }

  /// Reads in batches: a flood must not fill the buffer between two ticks.
  void ReadFrom(const Fd& fd, std::size_t at_most, bool stranger, const TimeSource& time,
                std::vector<NetFrame>& frames) {
    std::array<std::array<std::byte, kLargestFrame>, kBatch> bytes;
    std::array<Place, kBatch> places;
    std::array<iovec, kBatch> parts;
    std::array<mmsghdr, kBatch> messages{};
    for (std::size_t i = 0; i < kBatch; ++i) parts[i] = {bytes[i].data(), bytes[i].size()};
    for (std::size_t taken = 0; taken < at_most;) {
      for (std::size_t i = 0; i < kBatch; ++i) {
        messages[i].msg_hdr = {};
        messages[i].msg_hdr.msg_iov = &parts[i];
        messages[i].msg_hdr.msg_iovlen = 1;
        messages[i].msg_hdr.msg_name = &places[i].address;
        messages[i].msg_hdr.msg_namelen = sizeof places[i].address;
      }
      const int n = recvmmsg(fd.get(), messages.data(), kBatch, MSG_DONTWAIT, nullptr);
      if (n <= 0) return;  // nothing, or a report that an earlier one found nobody
      const Time now = time();
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        places[i].size = messages[i].msg_hdr.msg_namelen;
        Add(std::span(bytes[i]).first(messages[i].msg_len), places[i], stranger, now, frames);
      }
      taken += static_cast<std::size_t>(n);
      if (static_cast<std::size_t>(n) < kBatch) return;
    }
  }

  /// The frames of a datagram: one, as this program sends it.
  void Add(std::span<const std::byte> datagram, const Place& place, bool stranger, Time now,
           std::vector<NetFrame>& frames) {
    if (stranger) places_.push_back(place);
    const std::uint64_t index = stranger ? places_.size() - 1 : 0;
    while (!datagram.empty()) {
      const auto end = std::find(datagram.begin(), datagram.end(), kDelimiter);
      const auto length = static_cast<std::size_t>(end - datagram.begin());
      if (length > 0) frames.push_back({{datagram.begin(), end}, now, now, stranger, index});
      datagram = datagram.subspan(std::min(length + 1, datagram.size()));
    }
  }

  void Send(Time now) {
    (void)send(peer_.get(), frame_.data(), frame_.size(), MSG_NOSIGNAL);
    if (!maybe_ || (heard_at_ && now - *heard_at_ <= kPlaceSilence)) return;
    (void)sendto(strangers_.get(), frame_.data(), frame_.size(), MSG_NOSIGNAL,
                 reinterpret_cast<const sockaddr*>(&maybe_->address), maybe_->size);
  }

  std::string local_port_;
  Fd peer_, strangers_;
  std::vector<Place> places_;  ///< of the strangers of the last Read()
  std::optional<Place> maybe_;
  std::optional<Time> heard_at_;
  std::vector<std::byte> frame_;
};

}  // namespace

std::unique_ptr<NetPort> OpenUdpPort(const NetAddress& address) {
  return std::make_unique<UdpPort>(address);
}

}  // namespace priamos::radio
