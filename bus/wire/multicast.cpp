#include "bus/wire/multicast.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "bus/wire/bus_error.hpp"
#include "bus/wire/network_interface.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::bus {
namespace {

using Parameter = std::pair<std::string, std::string>;

/// Group and port of a URL, "239.255.76.67:7667" of "udpm://239.255.76.67:7667?ttl=0".
std::string_view AddressOf(std::string_view url) {
  const auto scheme = url.find("://");
  if (scheme == std::string_view::npos) return {};
  const std::string_view address = url.substr(scheme + 3);
  return address.substr(0, address.find('?'));
}

/// What follows the question mark, in its order.
std::vector<Parameter> ParametersOf(std::string_view url) {
  std::vector<Parameter> parameters;
  const auto question = url.find('?');
  std::string_view rest = question == std::string_view::npos ? "" : url.substr(question + 1);
  while (!rest.empty()) {
    const auto end = std::min(rest.find('&'), rest.size());
    const std::string_view one = rest.substr(0, end);
    const auto equals = std::min(one.find('='), one.size());
    if (!one.empty())
      parameters.emplace_back(one.substr(0, equals), one.substr(std::min(equals + 1, one.size())));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return parameters;
}

std::string ParameterOf(std::string_view url, std::string_view key) {
  for (const auto& [name, value] : ParametersOf(url))
    if (name == key) return value;
  return {};
}

in_addr MulticastAddress(const std::string& url) {
  in_addr address{};
  const std::string group = GroupOf(url);
  if (inet_pton(AF_INET, group.c_str(), &address) != 1 || (ntohl(address.s_addr) >> 28) != 0xe)
    throw BusError(fmt::format(
        "bus {}: expected a multicast address (224.0.0.0 to 239.255.255.255), got \"{}\"", url, group));
  return address;
}

/// Error of a socket that is told to send there; 0 if there is a way. `interface` 0: the route decides.
int ErrorOnTheWay(const sockaddr_in& address, unsigned interface) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return errno;
  ip_mreqn way{};
  way.imr_ifindex = static_cast<int>(interface);
  const bool there = (interface == 0 || setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &way, sizeof way) == 0) &&
                     connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const int error = there ? 0 : errno;
  close(fd);
  return error;
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

int TtlOf(const std::string& url) {
  const std::string text = ParameterOf(url, "ttl");
  if (text.empty()) return 0;
  int ttl = -1;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), ttl).ptr;
  if (end != text.data() + text.size() || ttl < 0 || ttl > 255)
    throw BusError(fmt::format("bus {}: ttl: expected 0 to 255, got \"{}\"", url, text));
  return ttl;
}

std::string NetworkOf(const std::string& url) {
  return ParameterOf(url, "network");
}

BusDeparture DepartureOf(const std::string& url) {
  if (!url.starts_with("udpm://")) return {};
  const std::string network = NetworkOf(url);
  const std::string way = network.empty() ? InterfaceOfRoute(GroupOf(url)) : network;
  for (const NetworkInterface& one : NetworkInterfaces()) {
    const auto& all = one.addresses;
    if (std::find(all.begin(), all.end(), way) != all.end()) return {one.name, way};
    if (one.name == way) return {one.name, all.empty() ? "" : all.front()};
  }
  return {};  // it was unplugged
}

std::string WithNetwork(const std::string& url, const std::string& network) {
  if (network.empty() || !url.starts_with("udpm://") || !NetworkOf(url).empty()) return url;
  return fmt::format("{}{}network={}", url, url.find('?') == std::string::npos ? '?' : '&', network);
}

std::string WithoutNetwork(const std::string& url) {
  if (NetworkOf(url).empty()) return url;
  std::string without = url.substr(0, url.find('?'));
  char mark = '?';
  for (const auto& [name, value] : ParametersOf(url)) {
    if (name == "network") continue;
    without += fmt::format("{}{}={}", std::exchange(mark, '&'), name, value);
  }
  return without;
}

void RequireMulticastUrl(const std::string& url) {
  MulticastAddress(url);
  const std::vector<std::string> known{"ttl", "network", "recv_buf_size"};
  for (const auto& parameter : ParametersOf(url))
    if (std::find(known.begin(), known.end(), parameter.first) == known.end())
      throw BusError(fmt::format("bus {}: expected ttl, network or recv_buf_size behind \"?\", got \"{}\"{}",
                                 url, parameter.first, NearestText(parameter.first, known)));
  TtlOf(url);
}

void RequireMulticastRoute(const std::string& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(PortOf(url));
  address.sin_addr = MulticastAddress(url);
  const std::string network = NetworkOf(url);
  if (!network.empty()) {
    const NetworkInterface interface = FindInterface(network);
    const int error = ErrorOnTheWay(address, interface.index);
    if (error == 0) return;
    throw BusError(
        fmt::format("bus {}: expected interface {} to be up with an address, got \"{}\"; next: "
                    "sudo ip link set {} up multicast on",
                    url, interface.name, std::strerror(error), interface.name));
  }
  const int error = ErrorOnTheWay(address, 0);
  if (error == 0) return;
  throw BusError(
      fmt::format("bus {}: expected a multicast route, got \"{}\"; without a network, make one with: "
                  "sudo ip link set lo up multicast on && sudo ip route add 224.0.0.0/4 dev lo",
                  url, std::strerror(error)));
}

}  // namespace priamos::bus
