#include "bus/wire/multicast.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "bus/wire/bus_error.hpp"
#include "bus/wire/socket_filter.hpp"

namespace priamos::bus {
namespace {

constexpr const char* kLcmDefaultGroup = "239.255.76.67";

}  // namespace

std::string GroupOf(const std::string& url) {
  const auto begin = url.find("://") + 3;
  const auto end = url.find_first_of(":?", begin);
  const std::string group = url.substr(begin, end == std::string::npos ? end : end - begin);
  return group.empty() ? kLcmDefaultGroup : group;
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
