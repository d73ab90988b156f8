#include "radio/net_socket.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace priamos::radio {

namespace {

constexpr std::uint32_t kLoopbackNet = 127;  // 127.0.0.0/8

}  // namespace

bool IsLoopback(const addrinfo& info) {
  if (info.ai_family == AF_INET)
    return ntohl(reinterpret_cast<const sockaddr_in*>(info.ai_addr)->sin_addr.s_addr) >> 24 == kLoopbackNet;
  return info.ai_family == AF_INET6 &&
         IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(info.ai_addr)->sin6_addr);
}

AddressInfo LookUp(const NetAddress& address) {
  const std::string host = address.host.empty() && address.loopback_only ? "127.0.0.1" : address.host;
  addrinfo hints{};
  hints.ai_socktype = address.datagrams ? SOCK_DGRAM : SOCK_STREAM;
  hints.ai_family = host.empty() ? AF_INET : AF_UNSPEC;
  hints.ai_flags = host.empty() ? AI_PASSIVE : 0;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.empty() ? nullptr : host.c_str(), address.port.c_str(), &hints, &found);
  if (error != 0)
    throw std::runtime_error(
        fmt::format("{}:{} cannot be looked up: {}", host, address.port, gai_strerror(error)));
  AddressInfo info(found);
  if (address.loopback_only && !IsLoopback(*info))
    throw std::runtime_error(
        fmt::format("{}:{}: expected an address of this machine, as for simulation_key, got one that others "
                    "can reach: make a key with `priamos link keygen`",
                    host, address.port));
  return info;
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

}  // namespace priamos::radio
