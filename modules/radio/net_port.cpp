#include "radio/net_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bus/radio/frame/frame.hpp"
#include "common/config.hpp"

namespace priamos::radio {
namespace {

using bus::radio::kDelimiter;

/// A connection that moves nothing for so long is dead; older bytes are worth nothing anyway.
constexpr unsigned kTcpTimeout_ms = 5000;
constexpr int kTcpSendBuffer = 4096;
constexpr auto kReconnect = std::chrono::seconds(1);
constexpr std::size_t kLargestDatagram = 2048;

/// A file descriptor that is closed when it is let go.
class Fd {
 public:
  explicit Fd(int fd = -1) : fd_(fd) {}
  Fd(Fd&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Fd& operator=(Fd&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Fd() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }
  bool open() const { return fd_ >= 0; }

 private:
  int fd_;
};

struct AddressInfoCloser {
  void operator()(addrinfo* info) const { freeaddrinfo(info); }
};
using AddressInfo = std::unique_ptr<addrinfo, AddressInfoCloser>;

/// Address of a host; an empty `host` means any address of this machine.
AddressInfo LookUp(const std::string& host, const std::string& port, int type) {
  addrinfo hints{};
  hints.ai_socktype = type;
  hints.ai_family = host.empty() ? AF_INET : AF_UNSPEC;
  hints.ai_flags = host.empty() ? AI_PASSIVE : 0;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.empty() ? nullptr : host.c_str(), port.c_str(), &hints, &found);
  if (error != 0)
    throw std::runtime_error(fmt::format("{}:{} cannot be looked up: {}", host, port, gai_strerror(error)));
  return AddressInfo(found);
}

Fd Socket(const addrinfo& info) {
  Fd fd(socket(info.ai_family, info.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, info.ai_protocol));
  if (!fd.open()) throw std::runtime_error(fmt::format("no socket can be had: {}", std::strerror(errno)));
  return fd;
}

void Bind(const Fd& fd, const addrinfo& info, const std::string& port) {
  const int on = 1;
  setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(fd.get(), info.ai_addr, info.ai_addrlen) != 0)
    throw std::runtime_error(fmt::format("port {} cannot be bound ({}): `ss -lunpt` names who holds it", port,
                                         std::strerror(errno)));
}

class UdpPort : public ByteStream {
 public:
  explicit UdpPort(const NetAddress& address) {
    const AddressInfo peer = LookUp(address.host, address.port, SOCK_DGRAM);
    fd_ = Socket(*peer);
    sockaddr_storage local{};
    local.ss_family = static_cast<sa_family_t>(peer->ai_family);
    const auto port = htons(static_cast<std::uint16_t>(std::stoul(address.local_port)));
    if (peer->ai_family == AF_INET) reinterpret_cast<sockaddr_in&>(local).sin_port = port;
    if (peer->ai_family == AF_INET6) reinterpret_cast<sockaddr_in6&>(local).sin6_port = port;
    addrinfo info = *peer;
    info.ai_addr = reinterpret_cast<sockaddr*>(&local);
    Bind(fd_, info, address.local_port);
    // From now on the kernel passes nothing but what comes from there.
    if (connect(fd_.get(), peer->ai_addr, peer->ai_addrlen) != 0)
      throw std::runtime_error(
          fmt::format("{}:{} cannot be reached: {}", address.host, address.port, std::strerror(errno)));
  }

  std::size_t Read(std::span<std::byte> into) override {
    if (arrived_.empty()) {
      std::array<std::byte, kLargestDatagram> datagram;
      const ssize_t n = recv(fd_.get(), datagram.data(), datagram.size(), 0);
      if (n <= 0) return 0;  // nothing, or a report that an earlier one found nobody
      arrived_.assign(datagram.begin(), datagram.begin() + n);
      if (arrived_.back() != kDelimiter) arrived_.push_back(kDelimiter);
    }
    const std::size_t n = std::min(into.size(), arrived_.size());
    std::copy_n(arrived_.begin(), n, into.begin());
    arrived_.erase(arrived_.begin(), arrived_.begin() + static_cast<std::ptrdiff_t>(n));
    return n;
  }

  std::size_t Write(std::span<const std::byte> bytes) override {
    for (const std::byte b : bytes) {
      frame_.push_back(b);
      if (b != kDelimiter) continue;
      // A lone delimiter is nothing. What the network does not take is lost.
      if (frame_.size() > 1) (void)send(fd_.get(), frame_.data(), frame_.size(), MSG_NOSIGNAL);
      frame_.clear();
    }
    return bytes.size();
  }

 private:
  Fd fd_;
  std::vector<std::byte> frame_, arrived_;
};

void TuneTcp(const Fd& fd) {
  const int on = 1;
  setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  setsockopt(fd.get(), IPPROTO_TCP, TCP_USER_TIMEOUT, &kTcpTimeout_ms, sizeof kTcpTimeout_ms);
  setsockopt(fd.get(), SOL_SOCKET, SO_SNDBUF, &kTcpSendBuffer, sizeof kTcpSendBuffer);
}

class TcpPort : public ByteStream {
 public:
  explicit TcpPort(const NetAddress& address)
      : peer_(LookUp(address.host.empty() && address.loopback_only ? "127.0.0.1" : address.host, address.port,
                     SOCK_STREAM)) {
    if (!address.host.empty()) return;
    listener_ = Socket(*peer_);
    Bind(listener_, *peer_, address.port);
    if (listen(listener_.get(), 1) != 0)
      throw std::runtime_error(fmt::format("port {}: {}", address.port, std::strerror(errno)));
  }

  std::size_t Read(std::span<std::byte> into) override {
    Renew();
    if (!fd_.open()) return 0;
    const ssize_t n = recv(fd_.get(), into.data(), into.size(), 0);
    if (n > 0) return static_cast<std::size_t>(n);
    if (n == 0 || !Pending()) fd_ = Fd();
    return 0;
  }

  std::size_t Write(std::span<const std::byte> bytes) override {
    if (!fd_.open()) return bytes.size();
    const ssize_t n = send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n >= 0) return static_cast<std::size_t>(n);
    if (Pending()) return 0;
    fd_ = Fd();
    return bytes.size();
  }

 private:
  static bool Pending() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOTCONN; }
  /// Takes a connection that waits, or tries to make one.
  void Renew() {
    if (listener_.open()) {
      Fd next(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
      if (!next.open()) return;
      fd_ = std::move(next);
      TuneTcp(fd_);
      return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (fd_.open() || now < next_try_) return;
    next_try_ = now + kReconnect;
    fd_ = Socket(*peer_);
    TuneTcp(fd_);
    if (connect(fd_.get(), peer_->ai_addr, peer_->ai_addrlen) != 0 && errno != EINPROGRESS) fd_ = Fd();
  }

  AddressInfo peer_;
  Fd listener_, fd_;
  std::chrono::steady_clock::time_point next_try_{};
};

bool IsPortNumber(const std::string& text) {
  return !text.empty() && text.size() <= 5 && text.find_first_not_of("0123456789") == std::string::npos &&
         std::stoul(text) <= 65535;
}

}  // namespace

bool IsNetPort(const std::string& port) {
  return port.rfind("udp:", 0) == 0 || port.rfind("tcp:", 0) == 0;
}

NetAddress ParseNetAddress(const std::string& port) {
  const auto refuse = [&] {
    throw ConfigError(fmt::format(
        "port: expected udp:HOST:PORT, udp:HOST:PORT@LOCAL, tcp:HOST:PORT or tcp::PORT, got \"{}\"", port));
  };
  NetAddress address;
  address.datagrams = port.rfind("udp:", 0) == 0;
  const std::string rest = port.substr(4);
  const std::size_t colon = rest.rfind(':'), at = rest.find('@');
  if (!IsNetPort(port) || colon == std::string::npos) refuse();
  address.host = rest.substr(0, colon);
  address.port = rest.substr(colon + 1, at == std::string::npos ? at : at - colon - 1);
  address.local_port = at == std::string::npos ? address.port : rest.substr(at + 1);
  if (address.host.size() > 1 && address.host.front() == '[' && address.host.back() == ']')
    address.host = address.host.substr(1, address.host.size() - 2);
  if (!IsPortNumber(address.port) || !IsPortNumber(address.local_port)) refuse();
  if (address.datagrams && address.host.empty()) refuse();
  if (!address.datagrams && at != std::string::npos) refuse();
  return address;
}

std::unique_ptr<ByteStream> OpenNetPort(const NetAddress& address) {
  if (address.datagrams) return std::make_unique<UdpPort>(address);
  return std::make_unique<TcpPort>(address);
}

}  // namespace priamos::radio
