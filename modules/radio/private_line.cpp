#include "radio/private_line.hpp"

#include <netdb.h>

#include <filesystem>

#include "radio/kiss_port.hpp"
#include "radio/net_port.hpp"
#include "radio/net_socket.hpp"

namespace priamos::radio {
namespace {

bool IsPseudoTerminal(const std::string& port) {
  std::error_code error;
  const auto real = std::filesystem::canonical(port, error);
  return !error && real.string().starts_with("/dev/pts/");
}

/// Every address of the host must be of this machine: nobody knows which one is taken.
bool IsOnLoopback(const std::string& host) {
  const addrinfo any{};  // not nullptr, which leaves out ::1 on a machine that has no other address of IPv6
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &any, &found) != 0) return false;
  const AddressInfo addresses(found);
  for (const addrinfo* info = found; info; info = info->ai_next)
    if (!IsLoopback(*info)) return false;
  return true;
}

}  // namespace

bool IsPrivateLine(const std::string& port) {
  if (IsKissPort(port)) return IsPseudoTerminal(TtyOf(port));
  if (!IsNetPort(port)) return IsPseudoTerminal(port);
  const NetAddress address = ParseNetAddress(port);
  return address.host.empty() || IsOnLoopback(address.host);
}

}  // namespace priamos::radio
