#pragma once

#include <cstdint>
#include <optional>

#include "lcmtypes/channels.hpp"
#include "robot/core/motion/drive_controller.hpp"
#include "robot/core/pose/localiser.hpp"

namespace priamos::robot {

/// The numbers by which messages name drivers, modes, limits and verdicts, and back. nullopt for a number
/// that names nobody.
std::optional<Driver> DriverOf(int code);
std::int8_t DriverCode(Driver driver);
/// The wish of a lease_request_t; nullopt for a number that names none.
std::optional<Lease::Wish> WishOf(int code);
/// drive_status_t::refusal.
std::int8_t RefusalCode(CommandVerdict verdict);
/// drive_status_t::mode.
std::int8_t ModeCode(DriveMode mode);
/// drive_status_t::limit.
std::int8_t LimitCode(Condition condition);
/// pose_correction_t::verdict.
std::int8_t VerdictCode(FixVerdict verdict);

}  // namespace priamos::robot
