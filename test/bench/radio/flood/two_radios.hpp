#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bus/schema/schema.hpp"
#include "cli/supervise/supervisor.hpp"

namespace priamos::bench {

/// UDP or TCP ports of the two ends on this machine.
inline constexpr std::uint16_t kOnboardPort = 7701, kOffboardPort = 7702;

/// LCM buses of the two ends.
std::string OnboardBus();
std::string OffboardBus();

/// The two priamos-radio of a link over UDP (`datagrams`) or TCP: onboard, then offboard. `folder` takes
/// their link.toml.
std::vector<cli::ProcessSpec> Ends(const std::string& programs, const std::string& folder, bool datagrams);

/// The types of their channels.
bus::Schema FloodTypes();
/// Message number `number` on their channel DRIVE.
std::vector<std::byte> DriveCommand(const bus::Schema& types, int number);

}  // namespace priamos::bench
