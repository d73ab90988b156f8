#include "bus/wire/network_interface.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "bus/wire/bus_error.hpp"
#include "common/text/nearest_word.hpp"

namespace priamos::bus {
namespace {

NetworkInterface& Entry(std::vector<NetworkInterface>& all, const ifaddrs& from) {
  const auto same = [&](const NetworkInterface& known) { return known.name == from.ifa_name; };
  if (const auto found = std::find_if(all.begin(), all.end(), same); found != all.end()) return *found;
  NetworkInterface made;
  made.index = if_nametoindex(from.ifa_name);
  made.name = from.ifa_name;
  made.up = (from.ifa_flags & IFF_UP) != 0;
  made.carrier = (from.ifa_flags & IFF_RUNNING) != 0;
  made.multicast = (from.ifa_flags & IFF_MULTICAST) != 0;
  made.loopback = (from.ifa_flags & IFF_LOOPBACK) != 0;
  return all.emplace_back(std::move(made));
}

std::string Listed(const std::vector<NetworkInterface>& all) {
  std::vector<std::string> texts;
  texts.reserve(all.size());
  for (const NetworkInterface& one : all)
    texts.push_back(one.addresses.empty() ? one.name
                                          : fmt::format("{} ({})", one.name, fmt::join(one.addresses, ", ")));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// The question "by which way to this address?" in the kernel's own language.
struct RouteQuestion {
  nlmsghdr header{};
  rtmsg route{};
  rtattr attribute{};
  in_addr to{};

  explicit RouteQuestion(in_addr address) : to(address) {
    header.nlmsg_len = sizeof *this;
    header.nlmsg_type = RTM_GETROUTE;
    header.nlmsg_flags = NLM_F_REQUEST;
    route.rtm_family = AF_INET;
    route.rtm_dst_len = 32;
    attribute.rta_type = RTA_DST;
    attribute.rta_len = RTA_LENGTH(sizeof to);
  }
};

/// Number of the interface in an answer; 0 when there is none in it.
unsigned OutInterface(const std::byte* answer, std::size_t size) {
  nlmsghdr header;
  if (size < NLMSG_LENGTH(sizeof(rtmsg))) return 0;
  std::memcpy(&header, answer, sizeof header);
  if (header.nlmsg_type != RTM_NEWROUTE || header.nlmsg_len > size) return 0;
  std::size_t at = NLMSG_LENGTH(sizeof(rtmsg));
  while (at + sizeof(rtattr) <= header.nlmsg_len) {
    rtattr attribute;
    std::memcpy(&attribute, answer + at, sizeof attribute);
    if (attribute.rta_len < sizeof attribute || at + attribute.rta_len > header.nlmsg_len) return 0;
    unsigned index = 0;
    if (attribute.rta_type == RTA_OIF && attribute.rta_len >= RTA_LENGTH(sizeof index)) {
      std::memcpy(&index, answer + at + RTA_LENGTH(0), sizeof index);
      return index;
    }
    at += RTA_ALIGN(attribute.rta_len);
  }
  return 0;
}

}  // namespace

std::vector<NetworkInterface> NetworkInterfaces() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(list, &freeifaddrs);
  std::vector<NetworkInterface> all;
  for (const ifaddrs* at = list; at != nullptr; at = at->ifa_next) {
    NetworkInterface& entry = Entry(all, *at);
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = "";
    sockaddr_in address;
    std::memcpy(&address, at->ifa_addr, sizeof address);
    inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
    entry.addresses.emplace_back(text);
  }
  return all;
}

NetworkInterface FindInterface(const std::string& name_or_address) {
  const auto all = NetworkInterfaces();
  std::vector<std::string> names;
  for (const NetworkInterface& one : all) {
    if (one.name == name_or_address) return one;
    if (std::find(one.addresses.begin(), one.addresses.end(), name_or_address) != one.addresses.end())
      return one;
    names.push_back(one.name);
  }
  throw BusError(fmt::format("network: expected an interface of this host or its address, {}, got \"{}\"{}",
                             Listed(all), name_or_address, NearestText(name_or_address, names)));
}

std::string InterfaceOfRoute(const std::string& to) {
  in_addr address{};
  if (inet_pton(AF_INET, to.c_str(), &address) != 1) return {};
  const int fd = socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (fd < 0) return {};
  const RouteQuestion question(address);
  std::array<std::byte, 4096> answer{};
  const bool asked = send(fd, &question, sizeof question, 0) == static_cast<ssize_t>(sizeof question);
  const ssize_t size = asked ? recv(fd, answer.data(), answer.size(), 0) : -1;
  close(fd);
  const unsigned index = size > 0 ? OutInterface(answer.data(), static_cast<std::size_t>(size)) : 0;
  char name[IF_NAMESIZE] = "";
  return index != 0 && if_indextoname(index, name) != nullptr ? name : "";
}

}  // namespace priamos::bus
