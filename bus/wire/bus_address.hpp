#pragma once

#include <string>
#include <string_view>

namespace priamos::bus {

/// The two buses of a robot: on the robot itself, and at its workstation.
enum class BusSide { kOnboard, kOffboard };

/// The name of a robot that was given none.
inline constexpr std::string_view kDefaultRobot = "priamos";

/// Environment variables behind `--robot`, `--bus`, `--network` and the time-to-live of named buses.
inline constexpr const char* kRobotVariable = "PRIAMOS_ROBOT";
inline constexpr const char* kBusVariable = "PRIAMOS_BUS";
inline constexpr const char* kTtlVariable = "PRIAMOS_TTL";
inline constexpr const char* kNetworkVariable = "PRIAMOS_NETWORK";

/// URL of a robot's bus, `udpm://GROUP:PORT?ttl=N`. Group (239.255.1 to 254.67 onboard, .68 offboard) and
/// port follow from the name, so that two robots in one network do not hear each other, and are never LCM's
/// own default. `ttl` counts routers: 0 stays on this host, 1 in the local network. Throws BusError for a
/// name that is not 1 to 32 of a-z, 0-9 and "-", or a ttl outside 0..255.
std::string BusUrl(std::string_view robot, BusSide side, int ttl);

/// LCM URL of a bus as a person types it: "onboard" or "offboard" of that robot, or any LCM URL, which is
/// returned as it is. Throws BusError for anything else.
std::string ResolveBus(std::string_view bus, std::string_view robot, int ttl);

}  // namespace priamos::bus
