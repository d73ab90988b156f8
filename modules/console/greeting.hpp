#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "bus/radio/link_config.hpp"
#include "common/ground_plan.hpp"
#include "console/console_config.hpp"

namespace priamos::console {

/// Channels of the workstation's bus that say something to a person. What drivers, `world` and others say
/// among each other is not for the station.
inline constexpr std::array kShownChannels{std::string_view("POSE"),
                                           std::string_view("DRIVE_STATUS"),
                                           std::string_view("MISSION_STATUS"),
                                           std::string_view("PATH"),
                                           std::string_view("LINK_STATUS"),
                                           std::string_view("HEALTH"),
                                           std::string_view("ALARM"),
                                           std::string_view("ALARM_ACK"),
                                           std::string_view("ESTOP"),
                                           std::string_view("LANDMARK_FIX"),
                                           std::string_view("LOOK_REQUEST"),
                                           std::string_view("DOOR_SEEN"),
                                           std::string_view("POSE_CORRECTION"),
                                           std::string_view("OPENING"),
                                           std::string_view("SONAR_RANGES"),
                                           std::string_view("LANDMARK_VIEW"),
                                           std::string_view("OBSTACLE_LINE"),
                                           std::string_view("LANDMARK_MODEL"),
                                           std::string_view("PARAMETER_VALUE"),
                                           std::string_view("PROCESS_STATE"),
                                           std::string_view("PROCESS_REPORT"),
                                           std::string_view("SIMULATION"),
                                           std::string_view("FLOOR_MAP"),
                                           std::string_view("HEAD_STATE"),
                                           std::string_view("DOOR_FOUND"),
                                           std::string_view("SCENE_OBJECT")};

/// Channels that the radio carries only while somebody looks at them.
std::set<std::string> OnRequest(const bus::radio::LinkConfig& link);

/// What a page has to know before anything else, as JSON: {"type": "hello", "plan", "body", "link":
/// {"bytes_per_s"}, "channels": {NAME: {"stale_after_s", "on_request"}}, "speed"}. stale_after_s: age from
/// which a state is grey, that of the radio where it is longer; 0 for events.
/// With a log of `replay_s` [s] also {"replay": {"length_s"}}; infinite: somebody else plays it, and
/// {"replay": {}}.
std::string Greeting(const ConsoleConfig& config, const GroundPlan& plan, const bus::radio::LinkConfig& link,
                     std::optional<double> replay_s = std::nullopt);

}  // namespace priamos::console
