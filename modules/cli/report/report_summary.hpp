#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/report_belief.hpp"
#include "cli/report/report_corridor.hpp"
#include "cli/report/report_explore.hpp"
#include "cli/report/report_found_doors.hpp"
#include "cli/report/report_found_objects.hpp"
#include "cli/report/report_hand.hpp"
#include "cli/report/report_record.hpp"
#include "cli/report/report_touches.hpp"
#include "cli/report/run_info.hpp"

namespace priamos::cli {

/// One landmark fix that corrected the pose, judged by the truth.
struct FixSummary {
  double t_s = 0;  ///< time of the correction since the order
  double error_before_m = 0, error_before_deg = 0;
  double error_after_m = 0, error_after_deg = 0;
  double sigma_m = 0, sigma_deg = 0;  ///< error that the robot itself estimates, one sigma
};

/// One direction of the radio, as its sender counts it.
struct RadioSummary {
  /// What the line carried of one channel in the whole run.
  struct ChannelSummary {
    std::string channel;
    int messages = 0;
    int bytes = 0;  ///< packed
    int dropped = 0;
  };

  std::int64_t bytes = 0;  ///< on the line, frames and all
  double utilisation = 0;  ///< share of the line, mean over the run
  int frames = 0;
  int dropped = 0;
  std::vector<ChannelSummary> channels;  ///< for the table; not in summary.json
};

/// Result of one run: summary.json, the same from the demo and from lockstep.
struct Summary {
  std::string scenario;
  std::uint64_t seed = 0;
  bool passed = false;                ///< the mission reports DONE and the base truly is behind the door
  std::string reason;                 ///< last line of the story; why, if it has not passed
  int contacts = 0;                   ///< what the base drove into, and holes
  std::vector<TouchSummary> touches;  ///< all, also what came to the base
  double min_gap_m = 0;               ///< smallest true distance of the footprint to anything
  std::optional<double> lateral_at_door_m;  ///< none when the door was not crossed
  std::optional<double> heading_at_door_deg;
  std::optional<BeliefAtDoor> belief_at_door;  ///< when it crossed the door
  CorrectionSummary corrections;
  std::optional<CorridorSummary> corridor;         ///< only of one that follows a corridor
  std::optional<FoundDoors> doors;                 ///< that the head found in passing
  std::optional<FoundObjects> things;              ///< that the head put together; only when any were told
  std::optional<ExploreSummary> explore;           ///< only of one that explores a floor
  double duration_s = 0;                           ///< from the order to the end of the mission
  double mean_speed_m_s = 0;                       ///< true distance over the time from first to last motion
  std::optional<double> min_speed_during_fix_m_s;  ///< true speed from look request to correction
  std::vector<FixSummary> fixes;
  RadioSummary up;                  ///< robot to workstation, as in link.toml
  RadioSummary down;                ///< workstation to robot
  std::optional<HandSummary> hand;  ///< only after a drive by hand
  double realtime_factor = 1;

  // Not in summary.json.
  double pose_age_s = 0;         ///< median age of a pose at the workstation
  std::vector<StoryLine> story;  ///< in order of time
};

/// An empty record gives a summary that has not passed.
Summary Summarise(const RunRecord& record, const RunInfo& info);

/// Summary of one direction of the radio; `reports` are of the end that sends.
RadioSummary RadioOf(const std::vector<link_status_t>& reports);

/// Whether the run is judged by fixes and by how straight it met the door; a drive by hand alone is not.
bool SeeksTheDoor(const Summary& summary);

/// The keys of summary.json; a figure that does not exist is null.
nlohmann::ordered_json ToJson(const Summary& summary);

}  // namespace priamos::cli
