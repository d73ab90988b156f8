#include "bus/wire/multicast.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

#include "bus/wire/bus_error.hpp"

namespace priamos::bus {
namespace {

constexpr const char* kLcmDefaultGroup = "239.255.76.67";
constexpr std::uint16_t kLcmDefaultPort = 7667;

/// Group and port of a URL, "239.255.76.67:7667" of "udpm://239.255.76.67:7667?ttl=0".
std::string_view AddressOf(std::string_view url) {
  const auto scheme = url.find("://");
  if (scheme == std::string_view::npos) return {};
  const std::string_view address = url.substr(scheme + 3);
  return address.substr(0, address.find('?'));
}

}  // namespace

std::string GroupOf(const std::string& url) {
  const std::string_view address = AddressOf(url);
  const std::string_view group = address.substr(0, address.find(':'));
  return std::string(group.empty() ? kLcmDefaultGroup : group);
}

std::uint16_t PortOf(const std::string& url) {
  const std::string_view address = AddressOf(url);
  const auto colon = address.find(':');
  if (colon == std::string_view::npos) return kLcmDefaultPort;
  std::uint16_t port = kLcmDefaultPort;
  // What follows the digits is left out, as liblcm does.
  std::from_chars(address.data() + colon + 1, address.data() + address.size(), port);
  return port;
}

void RequireMulticastRoute(const std::string& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(PortOf(url));
  const std::string group = GroupOf(url);
  if (inet_pton(AF_INET, group.c_str(), &address.sin_addr) != 1 ||
      (ntohl(address.sin_addr.s_addr) >> 28) != 0xe)
    throw BusError(fmt::format(
        "bus {}: expected a multicast address (224.0.0.0 to 239.255.255.255), got \"{}\"", url, group));
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool reachable = connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const int error = errno;
  close(fd);
  if (reachable) return;
  throw BusError(
      fmt::format("bus {}: expected a multicast route, got \"{}\"; without a network, make one with: "
                  "sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo",
                  url, std::strerror(error)));
}

}  // namespace priamos::bus
