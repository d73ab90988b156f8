#include "radio/private_line.hpp"

#include <netdb.h>
#include <netinet/in.h>

#include <filesystem>
#include <memory>

#include "radio/net_port.hpp"

namespace priamos::radio {
namespace {

constexpr std::uint32_t kLoopbackNet = 127;  // 127.0.0.0/8

bool IsPseudoTerminal(const std::string& port) {
  std::error_code error;
  const auto real = std::filesystem::canonical(port, error);
  return !error && real.string().starts_with("/dev/pts/");
}

bool IsLoopback(const addrinfo& info) {
  if (info.ai_family == AF_INET)
    return ntohl(reinterpret_cast<const sockaddr_in*>(info.ai_addr)->sin_addr.s_addr) >> 24 == kLoopbackNet;
  return info.ai_family == AF_INET6 &&
         IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(info.ai_addr)->sin6_addr);
}

/// Every address of the host must be of this machine: nobody knows which one is taken.
bool IsLoopback(const std::string& host) {
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, nullptr, &found) != 0) return false;
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, freeaddrinfo);
  for (const addrinfo* info = found; info; info = info->ai_next)
    if (!IsLoopback(*info)) return false;
  return true;
}

}  // namespace

bool IsPrivateLine(const std::string& port) {
  if (!IsNetPort(port)) return IsPseudoTerminal(port);
  const NetAddress address = ParseNetAddress(port);
  return address.host.empty() || IsLoopback(address.host);
}

}  // namespace priamos::radio
