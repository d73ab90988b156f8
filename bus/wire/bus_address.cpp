#include "bus/wire/bus_address.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "bus/wire/lcm_bus.hpp"
#include "common/text/nearest_word.hpp"
#include "common/text/text_hash.hpp"

namespace priamos::bus {
namespace {

// Below the ports that Linux gives to clients (32768 and up), above those of services. Even: onboard.
constexpr std::uint32_t kFirstPort = 20000;
constexpr std::uint32_t kPortPairs = 6000;
// The third byte of the group, 1 to 254: a switch that looks at groups keeps one robot's messages from
// another's cable.
constexpr std::uint32_t kGroups = 254;

constexpr std::size_t kLongestName = 32;

void RequireName(std::string_view robot) {
  const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  if (robot.empty() || robot.size() > kLongestName || !std::all_of(robot.begin(), robot.end(), allowed))
    throw BusError(
        fmt::format("robot \"{}\": expected a name of 1 to {} of a-z, 0-9 and \"-\"", robot, kLongestName));
}

}  // namespace

std::string BusUrl(std::string_view robot, BusSide side, int ttl) {
  RequireName(robot);
  if (ttl < 0 || ttl > 255) throw BusError(fmt::format("ttl: expected 0 to 255, got {}", ttl));
  const bool onboard = side == BusSide::kOnboard;
  const std::uint32_t hash = TextHash32(robot);
  const auto port = kFirstPort + 2 * (hash % kPortPairs) + (onboard ? 0 : 1);
  return fmt::format("udpm://239.255.{}.{}:{}?ttl={}", 1 + hash / kPortPairs % kGroups, onboard ? 67 : 68,
                     port, ttl);
}

std::string ResolveBus(std::string_view bus, std::string_view robot, int ttl) {
  if (bus == "onboard") return BusUrl(robot, BusSide::kOnboard, ttl);
  if (bus == "offboard") return BusUrl(robot, BusSide::kOffboard, ttl);
  if (bus.find("://") != std::string_view::npos) return std::string(bus);
  throw BusError(fmt::format(
      "bus \"{}\": expected onboard, offboard or an LCM URL such as udpm://239.255.76.67:7667?ttl=1{}", bus,
      NearestText(bus, std::vector<std::string>{"onboard", "offboard"})));
}

}  // namespace priamos::bus
