#include "radio/net_socket.hpp"

#include <fmt/format.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace priamos::radio {

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

}  // namespace priamos::radio
