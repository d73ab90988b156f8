#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "common/time.hpp"
#include "priamos/drive_status_t.hpp"
#include "priamos/mission_status_t.hpp"
#include "priamos/pose_t.hpp"

namespace priamos::cli {

/// The last messages of a bus about the robot's pose and state; empty: nothing was received.
struct Whereabouts {
  std::optional<pose_t> pose;
  std::optional<drive_status_t> drive;
  std::optional<mission_status_t> mission;
};

/// Four or five lines, at most 80 columns: pose with one sigma and age, motion, what the base does and what
/// limits it, the mission. Ages are against `now`, the clock of this machine.
std::string WhereText(const Whereabouts& where, Time now);

/// Pose, motion and mission as JSON; what was not heard is null.
nlohmann::ordered_json WhereJson(const Whereabouts& where, Time now);

}  // namespace priamos::cli
